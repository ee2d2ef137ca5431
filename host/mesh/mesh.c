// SPDX-License-Identifier: MIT
// Computes a mesh's bounds, drops its faulty triangles, and turns it so that z is up.
#include "mesh/mesh.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

bool mesh_allocate_vertices(Mesh *mesh, bool has_normals, bool has_colors, Error *error)
{
    const size_t count = mesh->vertex_count;
    mesh->positions = memory_raw(count, sizeof *mesh->positions, error);
    if (mesh->positions != NULL && has_normals)
        mesh->normals = memory_raw(count, sizeof *mesh->normals, error);
    if (mesh->positions != NULL && has_colors)
        mesh->colors = memory_raw(count, sizeof *mesh->colors, error);
    return mesh->positions != NULL && (mesh->normals != NULL || !has_normals) &&
           (mesh->colors != NULL || !has_colors);
}

void mesh_add_bounds(const Mesh *mesh, BoundingBox *box)
{
    BoundingBox grown = *box;
    for (size_t triangle = 0; triangle < mesh->triangle_count; triangle++)
        for (int corner = 0; corner < 3; corner++)
            bounding_box_add(&grown, mesh_corner(mesh, triangle, corner));
    *box = grown;
}

BoundingBox mesh_bounds(const Mesh *mesh)
{
    BoundingBox box = bounding_box_empty();
    mesh_add_bounds(mesh, &box);
    return box;
}

Vec3 mesh_direction(const Mesh *mesh, uint32_t from, uint32_t to)
{
    const double *a = mesh->positions[from], *b = mesh->positions[to];
    return vec3_normalize(vec3(b[0] - a[0], b[1] - a[1], b[2] - a[2]));
}

static bool is_same_point(const double *a, const double *b)
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

static bool is_lost(const double *point)
{
    return isnan(point[0]) || isnan(point[1]) || isnan(point[2]);
}

static bool has_equal_corners(const double *a, const double *b, const double *c)
{
    return is_same_point(a, b) || is_same_point(b, c) || is_same_point(c, a);
}

// Sets NaN positions to zero after their triangles are dropped, so that no later code reads a NaN.
static void clear_lost_vertices(Mesh *mesh)
{
    for (size_t vertex = 0; vertex < mesh->vertex_count; vertex++)
        if (is_lost(mesh->positions[vertex]))
            memset(mesh->positions[vertex], 0, sizeof mesh->positions[vertex]);
}

// Moves the remaining triangles to the front of the array.
bool mesh_drop_triangles(Mesh *mesh, Error *error)
{
    size_t kept = 0;
    const bool some_lost = mesh->bad_positions.count > 0;
    for (size_t index = 0; index < mesh->triangle_count; index++) {
        const uint32_t *triangle = mesh->triangles[index];
        const double *a = mesh->positions[triangle[0]];
        const double *b = mesh->positions[triangle[1]];
        const double *c = mesh->positions[triangle[2]];
        MeshFault *fault = some_lost && (is_lost(a) || is_lost(b) || is_lost(c))
                               ? &mesh->lost_corners
                           : has_equal_corners(a, b, c) ? &mesh->equal_corners
                                                        : NULL;
        if (fault != NULL) {
            mesh_fault_add(fault, index);
            if (!array_push(&mesh->dropped, (uint32_t)index, error))
                return false;
            continue;
        }
        if (kept < index)
            memcpy(mesh->triangles[kept], triangle, sizeof mesh->triangles[kept]);
        kept++;
    }
    mesh->triangle_count = kept;
    if (some_lost)
        clear_lost_vertices(mesh);
    return true;
}

// Before the i-th dropped triangle, dropped[i] - i triangles remain. This number never falls as i
// grows, so a binary search finds how many triangles were dropped before a remaining triangle.
size_t mesh_original_number(const Mesh *mesh, size_t triangle)
{
    size_t low = 0, high = mesh->dropped.count;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (mesh->dropped.data[middle] - middle <= triangle)
            low = middle + 1;
        else
            high = middle;
    }
    return triangle + low;
}

void mesh_drop_normals(Mesh *mesh)
{
    free(mesh->normals);
    mesh->normals = NULL;
}

void mesh_drop_colors(Mesh *mesh)
{
    free(mesh->colors);
    mesh->colors = NULL;
}

void mesh_free(Mesh *mesh)
{
    free(mesh->positions);
    free(mesh->normals);
    free(mesh->colors);
    free(mesh->triangles);
    free(mesh->dropped.data);
    *mesh = (Mesh){0};
}

// The code below rotates by multiples of 90 degrees. Each axis of the turned mesh is an axis of the
// original mesh, possibly with the opposite sign. UP_Y and UP_MINUS_Y keep the x axis. The other
// rotations keep the y axis, so that the front of the mesh, toward -y, stays in front.

const char *const up_axis_names[UP_AXES] = {"auto", "x", "y", "z", "-x", "-y", "-z"};

// The original axis for each axis of the turned mesh. 1, 2 and 3 stand for x, y and z. A negative
// number means that the coordinate is negated.
static const int sources[UP_AXES][3] = {
    [UP_X] = {-3, 2, 1},       [UP_Y] = {1, -3, 2},       [UP_Z] = {1, 2, 3},
    [UP_MINUS_X] = {3, 2, -1}, [UP_MINUS_Y] = {1, 3, -2}, [UP_MINUS_Z] = {-1, 2, -3}};

static Vec3 turned(Vec3 v, const int source[3])
{
    const double given[3] = {v.x, v.y, v.z};
    double result[3];
    for (int axis = 0; axis < 3; axis++) {
        const double value = given[abs(source[axis]) - 1];
        result[axis] = source[axis] < 0 ? -value : value;
    }
    return vec3_of_doubles(result);
}

void mesh_turn_up(Mesh *mesh, UpAxis up)
{
    if (up == UP_AUTO || up == UP_Z)
        return;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        double *p = mesh->positions[i];
        vec3_store_doubles(p, turned(vec3_of_doubles(p), sources[up]));
    }
    for (size_t i = 0; mesh->normals != NULL && i < mesh->vertex_count; i++) {
        float *n = mesh->normals[i];
        vec3_store(n, turned(vec3_of_floats(n), sources[up]));
    }
}
