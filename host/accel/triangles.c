// SPDX-License-Identifier: MIT
// Normalizes every vertex in fp64 and rounds it to float once. Triangles keep sharing vertices.
#include "accel/triangles.h"

#include <stdlib.h>

// A mesh, and where its points and triangles begin in the arrays of all meshes.
typedef struct {
    const Mesh *mesh;
    const Normalization *normalization;
    float (*points)[4];     // the mesh's section of Triangles::points
    uint32_t (*corners)[3]; // the mesh's section of Triangles::corners
    uint8_t *orders;        // the mesh's section of Triangles::orders
    uint32_t first_point;   // index of the mesh's first point
} Storing;

// Turns -0 into +0, because equal points must have equal bits.
static float without_negative_zero(float value)
{
    return value + 0.0f;
}

static void store_points(void *context, uint32_t chunk, uint32_t worker)
{
    const Storing *storing = context;
    const uint32_t end = chunk_end(chunk, (uint32_t)storing->mesh->vertex_count);
    (void)worker;
    for (uint32_t vertex = chunk * CHUNK_ELEMENTS; vertex < end; vertex++) {
        const double *position = storing->mesh->positions[vertex];
        const Vec3 p =
            normalize_point(storing->normalization, vec3(position[0], position[1], position[2]));
        float *point = storing->points[vertex];
        point[0] = without_negative_zero((float)p.x);
        point[1] = without_negative_zero((float)p.y);
        point[2] = without_negative_zero((float)p.z);
        point[3] = 0;
    }
}

static void store_corners(void *context, uint32_t chunk, uint32_t worker)
{
    const Storing *storing = context;
    const uint32_t end = chunk_end(chunk, (uint32_t)storing->mesh->triangle_count);
    (void)worker;
    for (uint32_t triangle = chunk * CHUNK_ELEMENTS; triangle < end; triangle++) {
        const uint32_t *vertices = storing->mesh->triangles[triangle];
        for (int corner = 0; corner < 3; corner++)
            storing->corners[triangle][corner] = storing->first_point + vertices[corner];
        storing->orders[triangle] =
            corner_order(storing->points[vertices[0]], storing->points[vertices[1]],
                         storing->points[vertices[2]]);
    }
}

static void store_mesh(Triangles *triangles, const Mesh *mesh, const Normalization *normalization,
                       Crew *crew)
{
    Storing storing = {mesh,
                       normalization,
                       triangles->points + triangles->point_count,
                       triangles->corners + triangles->count,
                       triangles->orders + triangles->count,
                       (uint32_t)triangles->point_count};
    crew_run(crew, chunk_count((uint32_t)mesh->vertex_count), store_points, &storing);
    crew_run(crew, chunk_count((uint32_t)mesh->triangle_count), store_corners, &storing);
    triangles->point_count += mesh->vertex_count;
    triangles->count += mesh->triangle_count;
}

static size_t vertex_count(const Scene *scene)
{
    size_t count = 0;
    for (size_t i = 0; i < scene->objects.count; i++)
        count += scene->objects.data[i].mesh.vertex_count;
    return count;
}

bool triangles_make(Triangles *triangles, const Scene *scene, const Normalization *normalization,
                    Crew *crew, Error *error)
{
    const size_t count = scene_triangle_count(scene), points = vertex_count(scene);
    *triangles = (Triangles){0};
    // Triangles and spheres share one range of ids; flags take two bits (kernels/shared.h).
    if (count + scene->spheres.count >= 0x3fffffff)
        return error_set(error, "the scene has %zu triangles, more than 2^30 primitives", count);
    if (points > UINT32_MAX)
        return error_set(error, "the scene has %zu vertices, more than 2^32", points);
    triangles->points = memory_raw(points, sizeof *triangles->points, error);
    triangles->corners = memory_raw(count, sizeof *triangles->corners, error);
    triangles->orders = memory_raw(count, sizeof *triangles->orders, error);
    if (triangles->points == NULL || triangles->corners == NULL || triangles->orders == NULL) {
        triangles_free(triangles);
        return false;
    }
    for (size_t i = 0; i < scene->objects.count; i++)
        store_mesh(triangles, &scene->objects.data[i].mesh, normalization, crew);
    return true;
}

void triangles_free(Triangles *triangles)
{
    free(triangles->points);
    free(triangles->corners);
    free(triangles->orders);
    *triangles = (Triangles){0};
}
