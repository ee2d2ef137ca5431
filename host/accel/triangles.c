// SPDX-License-Identifier: MIT
// Normalizes every vertex in fp64, rounds it once, and copies it to the triangles it is a corner
// of.
#include "accel/triangles.h"

#include <stdlib.h>
#include <string.h>

typedef struct {
    const Mesh *mesh;
    const Normalization *normalization;
    float (*points)[3];     // the mesh's vertices
    float (*corners)[3][3]; // of the mesh's triangles
} Storing;

static void store_points(void *context, uint32_t chunk, uint32_t worker)
{
    const Storing *storing = context;
    const uint32_t end = chunk_end(chunk, (uint32_t)storing->mesh->vertex_count);
    (void)worker;
    for (uint32_t vertex = chunk * CHUNK_ELEMENTS; vertex < end; vertex++) {
        const double *position = storing->mesh->positions[vertex];
        const Vec3 p =
            normalize_point(storing->normalization, vec3(position[0], position[1], position[2]));
        storing->points[vertex][0] = (float)p.x;
        storing->points[vertex][1] = (float)p.y;
        storing->points[vertex][2] = (float)p.z;
    }
}

static void store_corners(void *context, uint32_t chunk, uint32_t worker)
{
    const Storing *storing = context;
    const uint32_t end = chunk_end(chunk, (uint32_t)storing->mesh->triangle_count);
    (void)worker;
    for (uint32_t triangle = chunk * CHUNK_ELEMENTS; triangle < end; triangle++)
        for (int corner = 0; corner < 3; corner++)
            memcpy(storing->corners[triangle][corner],
                   storing->points[storing->mesh->triangles[triangle][corner]],
                   sizeof storing->corners[triangle][corner]);
}

static bool store_mesh(Storing *storing, Crew *crew, Error *error)
{
    const Mesh *mesh = storing->mesh;
    storing->points = memory_raw(mesh->vertex_count, sizeof *storing->points, error);
    if (storing->points == NULL)
        return false;
    crew_run(crew, chunk_count((uint32_t)mesh->vertex_count), store_points, storing);
    crew_run(crew, chunk_count((uint32_t)mesh->triangle_count), store_corners, storing);
    free(storing->points);
    return true;
}

bool triangles_make(Triangles *triangles, const Scene *scene, const Normalization *normalization,
                    Crew *crew, Error *error)
{
    const size_t count = scene_triangle_count(scene);
    // Ids share 32 bits with the spheres', and children on the traversal stack take one of them.
    if (count + scene->spheres.count >= 0x7fffffff)
        return error_set(error, "the scene has %zu triangles, more than 2^31 primitives", count);
    triangles->corners = memory_raw(count, sizeof *triangles->corners, error);
    if (triangles->corners == NULL)
        return false;
    for (size_t i = 0; i < scene->objects.count; i++) {
        Storing storing = {.mesh = &scene->objects.data[i].mesh,
                           .normalization = normalization,
                           .corners = triangles->corners + triangles->count};
        if (!store_mesh(&storing, crew, error)) {
            triangles_free(triangles);
            return false;
        }
        triangles->count += storing.mesh->triangle_count;
    }
    return true;
}

void triangles_free(Triangles *triangles)
{
    free(triangles->corners);
    *triangles = (Triangles){0};
}
