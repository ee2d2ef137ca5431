// SPDX-License-Identifier: MIT
// Scene -> counts of its faulty and unused parts, without rendering it.
#pragma once

#include "mesh/edges.h"
#include "scene/normalize.h"

// Edges -> whether a mesh is closed: every edge has two consistently oriented triangles, and the
// triangles around each point form one fan.

// Each MeshFault counts edges, points or triangles. Its field `first` is a triangle at a fault.
typedef struct {
    size_t edge_count;
    MeshFault open;       // edges of one triangle
    MeshFault crowded;    // edges of more than two triangles
    MeshFault turned;     // edges that both triangles follow in the same direction
    MeshFault pinched;    // points whose triangles form several fans
    MeshFault duplicates; // triangles with the corners of an earlier one, in any order
    bool is_closed;       // the mesh has triangles, and none of the first four faults
    bool is_inside_out;   // the mesh is closed, and the fronts face inwards
} Closedness;

bool closedness_find(Closedness *closedness, const Mesh *mesh, const Weld *weld, const Edges *edges,
                     Error *error);

// Mesh -> its finest details, in units of float spacing, as written and as traced.

// Among all triangles' lengths of one kind, the length with the fewest steps. A step is the spacing
// of floats at the triangle's largest coordinate.
typedef struct {
    double steps; // the length in steps; INFINITY if there is no length
    double size;  // the length in the scene's units
    size_t triangle;
} Feature;

typedef struct {
    Feature edge;         // shortest edge, in the traced frame
    Feature height;       // lowest height in that frame; triangles without area do not count
    Feature written_edge; // shortest edge, in the file's coordinates
    bool holds_floats;    // floats represent every coordinate exactly
    MeshFault flat;       // triangles without area: three corners on a line
    double extent;        // largest side of the mesh's bounds
    double offset;        // largest coordinate of the bounds' center
} Features;

Features features_of(const Mesh *mesh, const Normalization *normalization);

// The next two functions reject triangles without area. They report the first object that fails:
// its file, its first bad triangle and the count.

// Fails if the reader dropped a triangle with two equal corners.
bool bad_geometry_none_dropped(const Scene *scene, Error *error);

// Fails if any triangle has no area, dropped or not.
bool bad_geometry_none(const Scene *scene, Error *error);

// The counts of one mesh. Triangles are named by their numbers in the file. The Mesh itself holds
// the faults that its file reader found.
typedef struct {
    Closedness closedness;
    Features features;
    size_t unused_vertices;   // vertices that no triangle uses
    size_t repeated_vertices; // used vertices at the position of an earlier used vertex
} MeshCensus;

typedef struct {
    MeshCensus *meshes; // by object; owned
    size_t mesh_count;
    size_t empty_meshes;      // objects without a triangle
    size_t duplicate_meshes;  // objects with the triangles of an earlier one
    size_t duplicate_spheres; // spheres with center and radius of an earlier one
    size_t duplicate_lights;  // lights at the position of an earlier one
    size_t unused_materials;  // defined in the file, but not used
} Census;

// Counts the parts of a scene. `normalization` must be the scene's.
bool census_take(Census *census, const Scene *scene, const Normalization *normalization,
                 Error *error);
void census_free(Census *census);
