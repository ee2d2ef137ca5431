// SPDX-License-Identifier: MIT
// Corners -> fans across smooth edges -> one normal per fan. The weights are those of Thuermer and
// Wuethrich, "Computing Vertex Normals from Polygonal Facets" (1998): they make normals independent
// of how flat faces are triangulated.
#include "mesh/normals.h"

#include "base/array.h"
#include "base/limits.h"
#include "mesh/fans.h"

#include <stdlib.h>
#include <string.h>

// Edges of more faces are sharp, so that the pairs of faces at an edge stay few.
#define EDGE_FACES_MOST 8

// Keeps rounding from separating coplanar and opposite faces.
#define COSINE_SLACK 0x1p-40

// A face has no normal if the sines of its angles are all smaller: rounded coordinates turn such
// slivers by any angle.
#define SINE_LEAST 0x1p-20

// Smaller sums of faces are rounding errors of faces that cancel each other.
#define SUM_LEAST 0x1p-40

typedef struct {
    Vec3 normal;      // of length 1; zero for slivers
    double angles[3]; // in radians; zero for slivers
} Face;

typedef struct {
    const Mesh *mesh;
    double cosine; // smallest cosine between the normals of faces that a smooth edge joins
    Face *faces;   // by triangle
    Fans fans;     // later: by corner, the new vertex
    Vec3 *means;   // by fan: normal of unit length, or zero
    uint32_t fan_count;
} Smoothing;

static bool has_normal(const Mesh *mesh, uint32_t vertex)
{
    const float *n = mesh->normals != NULL ? mesh->normals[vertex] : NULL;
    return n != NULL && (n[0] != 0 || n[1] != 0 || n[2] != 0);
}

static bool is_complete(const Mesh *mesh)
{
    for (size_t triangle = 0; triangle < mesh->triangle_count; triangle++)
        for (int corner = 0; corner < 3; corner++)
            if (!has_normal(mesh, mesh->triangles[triangle][corner]))
                return false;
    return true;
}

static Face face_of(const Mesh *mesh, const uint32_t *triangle)
{
    Face face = {.normal = {0, 0, 0}};
    Vec3 next[3], previous[3], widest = {0, 0, 0}; // next and previous: directions from each corner
    for (int corner = 0; corner < 3; corner++) {
        next[corner] = mesh_direction(mesh, triangle[corner], triangle[(corner + 1) % 3]);
        previous[(corner + 1) % 3] = vec3_scale(next[corner], -1);
    }
    for (int corner = 0; corner < 3; corner++) {
        const Vec3 cross = vec3_cross(next[corner], previous[corner]);
        widest = vec3_dot(cross, cross) > vec3_dot(widest, widest) ? cross : widest;
    }
    if (vec3_extent(widest) < SINE_LEAST)
        return face;
    face.normal = vec3_normalize(widest);
    for (int corner = 0; corner < 3; corner++)
        face.angles[corner] = angle_between(next[corner], previous[corner]);
    return face;
}

static bool make_faces(Smoothing *smoothing, Error *error)
{
    const Mesh *mesh = smoothing->mesh;
    smoothing->faces = memory_raw(mesh->triangle_count, sizeof *smoothing->faces, error);
    for (size_t i = 0; smoothing->faces != NULL && i < mesh->triangle_count; i++)
        smoothing->faces[i] = face_of(mesh, mesh->triangles[i]);
    return smoothing->faces != NULL;
}

static bool is_smooth(const Smoothing *smoothing, uint32_t triangle, uint32_t other)
{
    const Vec3 a = smoothing->faces[triangle].normal, b = smoothing->faces[other].normal;
    return vec3_dot(a, a) > 0 && vec3_dot(b, b) > 0 && vec3_dot(a, b) >= smoothing->cosine;
}

static void join_edge(const Smoothing *smoothing, uint32_t low, const EdgeSide *sides, size_t count)
{
    for (size_t i = 1; i < count && count <= EDGE_FACES_MOST; i++)
        for (size_t j = 0; j < i; j++)
            if (is_smooth(smoothing, sides[i].triangle, sides[j].triangle)) {
                fans_join(&smoothing->fans, low, sides[i].triangle, sides[j].triangle);
                fans_join(&smoothing->fans, sides[i].high, sides[i].triangle, sides[j].triangle);
            }
}

static void join_edges(const Smoothing *smoothing, const Edges *edges)
{
    for (uint32_t point = 0; point < smoothing->mesh->vertex_count; point++)
        for (size_t place = edges->first[point], end; place < edges->first[point + 1];
             place = end) {
            end = edges_end(edges, point, place);
            join_edge(smoothing, point, &edges->sides[place], end - place);
        }
}

static bool make_fans(Smoothing *smoothing, Error *error)
{
    Weld weld = {0};
    Edges edges = {0};
    const Mesh *mesh = smoothing->mesh;
    const bool ok = weld_make(&weld, mesh, error) && edges_make(&edges, mesh, &weld, error) &&
                    fans_make(&smoothing->fans, mesh, &weld, error);
    if (ok)
        join_edges(smoothing, &edges);
    edges_free(&edges);
    weld_free(&weld);
    return ok;
}

// Sums in the order of the corners, so that the result depends on nothing else.
static bool make_means(Smoothing *smoothing, Error *error)
{
    const uint32_t *fans = smoothing->fans.parents;
    smoothing->fan_count = fans_number(&smoothing->fans);
    smoothing->means = memory_zeroed(smoothing->fan_count, sizeof *smoothing->means, error);
    if (smoothing->means == NULL)
        return false;
    for (size_t corner = 0; corner < 3 * smoothing->mesh->triangle_count; corner++) {
        const Face *face = &smoothing->faces[corner / 3];
        Vec3 *mean = &smoothing->means[fans[corner]];
        *mean = vec3_add(*mean, vec3_scale(face->normal, face->angles[corner % 3]));
    }
    for (uint32_t fan = 0; fan < smoothing->fan_count; fan++) {
        const Vec3 sum = smoothing->means[fan];
        smoothing->means[fan] = vec3_extent(sum) > SUM_LEAST ? vec3_normalize(sum) : vec3(0, 0, 0);
    }
    return true;
}

// Returns whether a corner needs a vertex of its own: it has a normal, or its fan bends by more
// than the crease angle, as at the tip of a cone, and the mean does not suit its face.
static bool is_alone(const Smoothing *smoothing, size_t corner)
{
    const Vec3 mean = smoothing->means[smoothing->fans.parents[corner]];
    return has_normal(smoothing->mesh, smoothing->mesh->triangles[corner / 3][corner % 3]) ||
           vec3_dot(mean, mean) == 0 ||
           vec3_dot(mean, smoothing->faces[corner / 3].normal) < smoothing->cosine;
}

static void store_normal(float normal[3], Vec3 value)
{
    normal[0] = (float)value.x;
    normal[1] = (float)value.y;
    normal[2] = (float)value.z;
}

// Makes one vertex per fan and per corner that is alone. Stores each corner's vertex in fans.
static bool make_vertices(Mesh *made, Smoothing *smoothing, Error *error)
{
    const Mesh *mesh = smoothing->mesh;
    const size_t corners = 3 * mesh->triangle_count;
    size_t count = smoothing->fan_count;
    for (size_t corner = 0; corner < corners; corner++)
        count += is_alone(smoothing, corner);
    if (count > (size_t)MESH_COUNT_MOST)
        return error_set(error, "its normals need %zu vertices, which are too many", count);
    made->positions = memory_raw(count, sizeof *made->positions, error);
    made->normals = memory_raw(count, sizeof *made->normals, error);
    if (made->positions == NULL || made->normals == NULL)
        return false;
    made->vertex_count = smoothing->fan_count;
    for (size_t corner = 0; corner < corners; corner++) {
        const uint32_t old = mesh->triangles[corner / 3][corner % 3];
        uint32_t *vertex = &smoothing->fans.parents[corner];
        const bool alone = is_alone(smoothing, corner);
        memcpy(made->positions[*vertex], mesh->positions[old], sizeof *made->positions);
        store_normal(made->normals[*vertex], smoothing->means[*vertex]);
        if (!alone)
            continue;
        *vertex = (uint32_t)made->vertex_count++;
        memcpy(made->positions[*vertex], mesh->positions[old], sizeof *made->positions);
        if (has_normal(mesh, old))
            memcpy(made->normals[*vertex], mesh->normals[old], sizeof *made->normals);
        else
            store_normal(made->normals[*vertex], smoothing->faces[corner / 3].normal);
    }
    return true;
}

static void replace_vertices(Mesh *mesh, Mesh *made, const uint32_t *vertices)
{
    free(mesh->positions);
    free(mesh->normals);
    mesh->positions = made->positions;
    mesh->normals = made->normals;
    mesh->vertex_count = made->vertex_count;
    memcpy(mesh->triangles, vertices, mesh->triangle_count * sizeof *mesh->triangles);
    *made = (Mesh){0};
}

bool mesh_compute_normals(Mesh *mesh, double crease_degrees, Error *error)
{
    Mesh made = {0};
    Smoothing smoothing = {.mesh = mesh,
                           .cosine = cosine_of_degrees(crease_degrees) - COSINE_SLACK};
    if (is_complete(mesh))
        return true;
    const bool ok = make_faces(&smoothing, error) && make_fans(&smoothing, error) &&
                    make_means(&smoothing, error) && make_vertices(&made, &smoothing, error);
    if (ok)
        replace_vertices(mesh, &made, smoothing.fans.parents);
    mesh_free(&made);
    free(smoothing.faces);
    free(smoothing.means);
    fans_free(&smoothing.fans);
    return ok;
}
