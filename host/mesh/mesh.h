// SPDX-License-Identifier: MIT
// An indexed triangle mesh with fp64 positions, in the coordinates of its file or scene.
#pragma once

#include "base/array.h"
#include "base/bounding_box.h"

#include <stddef.h>
#include <stdint.h>

// The faults of one kind in a mesh.
typedef struct {
    size_t count;
    size_t first; // lowest index of a faulty triangle or vertex; meaningless if `count` is 0
} MeshFault;

static inline void mesh_fault_add(MeshFault *fault, size_t place)
{
    if (fault->count++ == 0 || place < fault->first)
        fault->first = place;
}

typedef uint32_t Triangle[3]; // vertex indices, counter-clockwise seen from the front

typedef struct {
    double (*positions)[3]; // vertex_count finite points, each |component| <= 1e30
    float (*normals)[3]; // vertex_count finite vectors of any length, zero for vertices without a
                         // normal; NULL if the mesh has no normals
    float (*colors)[3]; // vertex_count colors, components in [0, 1]; NULL if the mesh has no colors
    Triangle *triangles; // triangle_count triangles
    size_t vertex_count, triangle_count;
    ARRAY(uint32_t) dropped; // original numbers of the removed triangles, ascending
    MeshFault equal_corners; // removed triangles with two equal corners
    MeshFault lost_corners;  // removed triangles with a bad position
    // Vertices with a bad position, and vertices with a bad component of the normal: not finite or
    // too large. Such positions and components become zero. ply_parse accepts them only if
    // PlySource::is_tolerant.
    MeshFault bad_positions, bad_normals;
} Mesh;

static inline Vec3 mesh_corner(const Mesh *mesh, size_t triangle, int corner)
{
    return vec3_of_doubles(mesh->positions[mesh->triangles[triangle][corner]]);
}

// Allocates arrays for mesh->vertex_count vertices, without values. Fails if memory runs out. The
// caller must then free the mesh.
bool mesh_allocate_vertices(Mesh *mesh, bool has_normals, bool has_colors, Error *error);

// Extends `box` to contain all vertices that triangles use.
void mesh_add_bounds(const Mesh *mesh, BoundingBox *box);

// Returns the box of all vertices that triangles use.
BoundingBox mesh_bounds(const Mesh *mesh);

// Returns the direction from one vertex to another. The direction has length 1, or is zero if the
// vertices coincide.
Vec3 mesh_direction(const Mesh *mesh, uint32_t from, uint32_t to);

// Removes triangles with two equal corners or a NaN position, and lists their numbers in
// mesh->dropped. Then sets NaN positions to zero. Fails if memory runs out. The caller must then
// free the mesh.
bool mesh_drop_triangles(Mesh *mesh, Error *error);

// Returns the number that a triangle had before mesh_drop_triangles.
size_t mesh_original_number(const Mesh *mesh, size_t triangle);

// Removes the normals, so that the mesh is shaded flat.
void mesh_drop_normals(Mesh *mesh);

// Removes the colors, so that the mesh has the diffuse color of its material.
void mesh_drop_colors(Mesh *mesh);

// Frees the mesh's memory and leaves a valid empty mesh.
void mesh_free(Mesh *mesh);

// The following declarations turn meshes so that z points up, as clrt's cameras assume by default.

// The axis of a file's coordinates that points up.
typedef enum {
    UP_AUTO, // not known
    UP_X,
    UP_Y,
    UP_Z,
    UP_MINUS_X,
    UP_MINUS_Y,
    UP_MINUS_Z,
    UP_AXES
} UpAxis;

// The axes as users write them: "auto", "x" to "-z".
extern const char *const up_axis_names[UP_AXES];

// Rotates positions and normals so that the axis `up` becomes z. The rotation only exchanges
// coordinates and changes signs, without rounding. UP_AUTO and UP_Z change nothing.
void mesh_turn_up(Mesh *mesh, UpAxis up);
