// SPDX-License-Identifier: MIT
// Edges -> whether a mesh is closed: its triangles meet two by two along every edge, turn the same
// way, and surround every point once.
#pragma once

#include "check/edges.h"

// Faults are counted by edge or point; their first is the lowest triangle at one.
typedef struct {
    size_t edge_count;
    MeshFault open;       // edges of one triangle
    MeshFault crowded;    // edges of more than two
    MeshFault turned;     // edges of two that run along them in the same direction
    MeshFault pinched;    // points whose triangles meet nowhere else
    MeshFault duplicates; // triangles with the corners of one before, in any order
    bool is_closed;       // there are triangles and none of the first four
    bool is_inside_out;   // closed, and the fronts face what it encloses
} Closedness;

bool closedness_find(Closedness *closedness, const Mesh *mesh, const Weld *weld, const Edges *edges,
                     Error *error);
