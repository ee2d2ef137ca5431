// SPDX-License-Identifier: MIT
// Joins the corners of triangles into fans across smooth edges, and makes one vertex per fan. The
// vertex's normal is the mean of the triangles' normals, weighted by the triangles' angles at the
// vertex (Thuermer and Wuethrich, "Computing Vertex Normals from Polygonal Facets", 1998). With
// these weights, normals do not depend on how a flat polygon is divided into triangles. In this
// file, a face is a triangle.
#include "mesh/normals.h"

#include "base/array.h"
#include "base/limits.h"
#include "base/thread_pool.h"
#include "mesh/edges.h"

#include <stdlib.h>
#include <string.h>

// The following functions choose the crease angle of a mesh, up to which edges are smooth. The
// normals of adjacent faces of a smooth shape usually differ by small angles. Technical shapes have
// chamfers and sharp edges, so some larger angles are frequent.

// Meshes with fewer edges than this are too small for statistics, and get CREASE_DEGREES.
#define EDGES_LEAST 1000

#define ROUND_CREASE_DEGREES 70 // for smooth shapes

// The cosine of the largest angle in each window of EdgeAngles.
static const double ends[ANGLE_WINDOWS] = {
    0.99619469809174555, 0.98480775301220806, 0.96592582628906829, 0.93969262078590838,
    0.90630778703664996, 0.86602540378443865, 0.81915204428899178, 0.76604444311897804,
    0.70710678118654752, 0.64278760968653933, 0.57357643635104610, 0.50000000000000000,
    0.42261826174069944, 0.34202014332566873, 0.25881904510252076};

// Adds an edge between two triangles. `a` and `b` are the triangles' unit normals. A triangle
// without area has a zero vector instead.
static void edge_angles_add(EdgeAngles *angles, Vec3 a, Vec3 b)
{
    int window = 0;
    while (window < ANGLE_WINDOWS && vec3_dot(a, b) <= ends[window])
        window++;
    angles->edges++;
    if (window < ANGLE_WINDOWS)
        angles->windows[window]++;
}

static Vec3 normal_of(const Mesh *mesh, const EdgeSide *side)
{
    const uint32_t *triangle = mesh->triangles[side->triangle];
    const Vec3 ab = mesh_direction(mesh, triangle[0], triangle[1]);
    return vec3_normalize(vec3_cross(ab, mesh_direction(mesh, triangle[0], triangle[2])));
}

bool normals_add_angles(EdgeAngles *angles, const Mesh *mesh, Error *error)
{
    Edges edges = {0};
    Edge edge = {0};
    const bool ok = edges_make(&edges, mesh, error);
    while (ok && edges_next(&edges, &edge))
        if (edge.count == 2)
            edge_angles_add(angles, normal_of(mesh, &edge.sides[0]),
                            normal_of(mesh, &edge.sides[1]));
    edges_free(&edges);
    return ok;
}

// Returns the number of edges per degree between the angles `from` and `to`, which are multiples of
// ANGLE_WINDOW_DEGREES.
static double density(const EdgeAngles *angles, int from, int to)
{
    size_t sum = 0;
    for (int window = from / ANGLE_WINDOW_DEGREES; window < to / ANGLE_WINDOW_DEGREES; window++)
        sum += angles->windows[window];
    return (double)sum / (to - from);
}

double normals_crease(const EdgeAngles *angles)
{
    const double common = density(angles, 25, 35);
    bool is_round = angles->edges >= EDGES_LEAST && common > 0 &&
                    density(angles, 5, 15) > density(angles, 15, 25) &&
                    density(angles, 15, 25) > common && density(angles, 55, 75) < common / 5;
    for (int from = 35; from < 75; from += ANGLE_WINDOW_DEGREES)
        is_round = is_round && density(angles, from, from + ANGLE_WINDOW_DEGREES) < common;
    return is_round ? ROUND_CREASE_DEGREES : CREASE_DEGREES;
}

// Edges with more faces than this are sharp. The limit bounds the pairs of faces that join_edge
// compares.
#define EDGE_FACES_MOST 8

// With this slack, a crease angle of 0 degrees joins coplanar faces despite rounding, and a crease
// angle of 180 degrees joins opposite faces.
#define COSINE_SLACK 0x1p-40

// A triangle is a sliver if the sum of the sines of its angles is below about this limit. Rounded
// coordinates can turn the normal of a sliver by any angle.
#define SINE_LEAST 0x1p-20

// Sums of normals shorter than this count as zero, because they are rounding errors that remain
// when the normals cancel.
#define SUM_LEAST 0x1p-40

typedef struct {
    Vec3 normal;      // of length 1; zero for slivers
    double angles[3]; // in radians; zero for slivers
} FaceNormal;

typedef struct {
    Vec3 normal;
    uint32_t old; // a vertex of the original mesh at this position
} FanVertex;

typedef struct {
    const Mesh *mesh;
    double cosine; // edges are smooth if the cosine between their faces' normals is at least this
    FaceNormal *faces; // by triangle
    Fans fans;         // after make_vertices, parents holds the vertex of each corner
    ARRAY(FanVertex) vertices;
} Smoothing;

static Vec3 given_normal(const Mesh *mesh, uint32_t vertex)
{
    const float *n = mesh->normals != NULL ? mesh->normals[vertex] : (const float[3]){0, 0, 0};
    return vec3_of_floats(n);
}

bool mesh_has_all_normals(const Mesh *mesh)
{
    for (size_t corner = 0; corner < 3 * mesh->triangle_count; corner++)
        if (vec3_extent(given_normal(mesh, mesh->triangles[corner / 3][corner % 3])) == 0)
            return false;
    return true;
}

static FaceNormal face_of(const Mesh *mesh, const uint32_t *triangle)
{
    FaceNormal face;
    Vec3 sides[3], sum = {0, 0, 0}; // sides[i] goes from corner i to the next corner
    for (int corner = 0; corner < 3; corner++)
        sides[corner] = mesh_direction(mesh, triangle[corner], triangle[(corner + 1) % 3]);
    for (int corner = 0; corner < 3; corner++) {
        const Vec3 a = sides[corner], b = vec3_scale(sides[(corner + 2) % 3], -1);
        sum = vec3_add(sum, vec3_cross(a, b));
        face.angles[corner] = angle_between(a, b);
    }
    face.normal = vec3_normalize(sum);
    return vec3_extent(sum) < SINE_LEAST ? (FaceNormal){.angles = {0}} : face;
}

static void make_faces(void *context, uint32_t first, uint32_t end)
{
    const Smoothing *smoothing = context;
    const Mesh *mesh = smoothing->mesh;
    for (uint32_t i = first; i < end; i++)
        smoothing->faces[i] = face_of(mesh, mesh->triangles[i]);
}

// On one thread, the angles of the faces take about half of the time of smoothing.
static bool share_faces(Smoothing *smoothing, Error *error)
{
    const size_t count = smoothing->mesh->triangle_count;
    smoothing->faces = memory_raw(count, sizeof *smoothing->faces, error);
    if (smoothing->faces == NULL)
        return false;
    ThreadPool *pool = thread_pool_open(0);
    thread_pool_share(pool, (uint32_t)count, CHUNK_ELEMENTS, make_faces, smoothing);
    thread_pool_close(pool);
    return true;
}

static void join_edge(const Smoothing *smoothing, const Edge *edge)
{
    for (size_t i = 1; i < edge->count && edge->count <= EDGE_FACES_MOST; i++)
        for (size_t j = 0; j < i; j++) {
            const uint32_t one = edge->sides[i].triangle, other = edge->sides[j].triangle;
            const Vec3 a = smoothing->faces[one].normal, b = smoothing->faces[other].normal;
            if (vec3_dot(a, a) * vec3_dot(b, b) == 0 || vec3_dot(a, b) < smoothing->cosine)
                continue;
            fans_join(&smoothing->fans, edge->low, one, other);
            fans_join(&smoothing->fans, edge->sides[i].high, one, other);
        }
}

static void choose_crease(Smoothing *smoothing, const Edges *edges)
{
    Edge edge = {0};
    EdgeAngles angles = {0};
    const FaceNormal *faces = smoothing->faces;
    while (edges_next(edges, &edge))
        if (edge.count == 2)
            edge_angles_add(&angles, faces[edge.sides[0].triangle].normal,
                            faces[edge.sides[1].triangle].normal);
    smoothing->cosine = cosine_of_degrees(normals_crease(&angles)) - COSINE_SLACK;
}

static bool make_fans(Smoothing *smoothing, bool is_by_shape, Error *error)
{
    Edges edges = {0};
    Edge edge = {0};
    const Mesh *mesh = smoothing->mesh;
    const bool ok = edges_make(&edges, mesh, error) &&
                    fans_make(&smoothing->fans, mesh, &edges, error) &&
                    share_faces(smoothing, error);
    if (ok && is_by_shape)
        choose_crease(smoothing, &edges);
    while (ok && edges_next(&edges, &edge))
        join_edge(smoothing, &edge);
    edges_free(&edges);
    return ok;
}

// Makes one vertex per fan. Sums the normals in the order of the corners, so that the result is
// reproducible.
static bool make_vertices(Smoothing *smoothing, Error *error)
{
    const size_t count = fans_number(&smoothing->fans);
    FanVertex *vertices = memory_zeroed(count, sizeof *vertices, error);
    smoothing->vertices.data = vertices;
    smoothing->vertices.count = smoothing->vertices.capacity = count;
    for (size_t i = 0; vertices != NULL && i < 3 * smoothing->mesh->triangle_count; i++) {
        const FaceNormal *face = &smoothing->faces[i / 3];
        FanVertex *vertex = &vertices[smoothing->fans.parents[i]];
        vertex->normal = vec3_add(vertex->normal, vec3_scale(face->normal, face->angles[i % 3]));
        vertex->old = smoothing->mesh->triangles[i / 3][i % 3];
    }
    for (size_t i = 0; vertices != NULL && i < count; i++)
        vertices[i].normal = vec3_extent(vertices[i].normal) > SUM_LEAST
                                 ? vec3_normalize(vertices[i].normal)
                                 : vec3(0, 0, 0);
    return vertices != NULL;
}

static bool have_same_color(const Mesh *mesh, uint32_t vertex, uint32_t other)
{
    return mesh->colors == NULL ||
           memcmp(mesh->colors[vertex], mesh->colors[other], sizeof *mesh->colors) == 0;
}

// Gives a corner its own vertex in four cases:
// - The file has a normal for the corner.
// - The corner's color differs from the fan's color.
// - The fan's mean normal is zero.
// - The mean normal differs from the face's normal by more than the crease angle, as at the tip of
// a cone.
static bool split_corners(Smoothing *smoothing, Error *error)
{
    for (size_t i = 0; i < 3 * smoothing->mesh->triangle_count; i++) {
        const uint32_t old = smoothing->mesh->triangles[i / 3][i % 3];
        uint32_t *place = &smoothing->fans.parents[i];
        const FanVertex fan = smoothing->vertices.data[*place];
        const Vec3 mean = fan.normal;
        const Vec3 face = smoothing->faces[i / 3].normal,
                   given = given_normal(smoothing->mesh, old);
        const bool is_given = vec3_dot(given, given) > 0;
        const bool is_mean =
            !is_given && vec3_dot(mean, mean) > 0 && vec3_dot(mean, face) >= smoothing->cosine;
        if (is_mean && have_same_color(smoothing->mesh, old, fan.old))
            continue;
        const FanVertex own = {is_given ? given : is_mean ? mean : face, old};
        *place = (uint32_t)smoothing->vertices.count;
        if (!array_push(&smoothing->vertices, own, error))
            return false;
    }
    return smoothing->vertices.count <= (size_t)MESH_COUNT_MOST ||
           error_set(error, "its normals need %zu vertices, more than %zu",
                     smoothing->vertices.count, (size_t)MESH_COUNT_MOST);
}

static bool replace_vertices(Mesh *mesh, const Smoothing *smoothing, Error *error)
{
    const size_t count = smoothing->vertices.count;
    Mesh made = {.vertex_count = count};
    const bool ok = mesh_allocate_vertices(&made, true, mesh->colors != NULL, error);
    for (size_t i = 0; ok && i < count; i++) {
        const FanVertex *vertex = &smoothing->vertices.data[i];
        memcpy(made.positions[i], mesh->positions[vertex->old], sizeof *made.positions);
        vec3_store(made.normals[i], vertex->normal);
        if (made.colors != NULL)
            memcpy(made.colors[i], mesh->colors[vertex->old], sizeof *made.colors);
    }
    if (ok) {
        const Mesh old = *mesh;
        mesh->positions = made.positions;
        mesh->normals = made.normals;
        mesh->colors = made.colors;
        mesh->vertex_count = count;
        memcpy(mesh->triangles, smoothing->fans.parents,
               3 * sizeof(uint32_t) * mesh->triangle_count);
        made = (Mesh){.positions = old.positions, .normals = old.normals, .colors = old.colors};
    }
    mesh_free(&made);
    return ok;
}

bool mesh_compute_normals(Mesh *mesh, double crease_degrees, Error *error)
{
    Smoothing smoothing = {.mesh = mesh,
                           .cosine = cosine_of_degrees(crease_degrees) - COSINE_SLACK};
    const bool ok = mesh_has_all_normals(mesh) ||
                    (make_fans(&smoothing, crease_degrees == CREASE_BY_SHAPE, error) &&
                     make_vertices(&smoothing, error) && split_corners(&smoothing, error) &&
                     replace_vertices(mesh, &smoothing, error));
    free(smoothing.faces);
    free(smoothing.vertices.memory);
    free(smoothing.fans.parents);
    return ok;
}
