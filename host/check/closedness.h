// SPDX-License-Identifier: MIT
// Edges -> whether a mesh is closed: two triangles meet at every edge, with one orientation, and
// surround every point once.
#pragma once

#include "check/edges.h"

// Faults count edges or points; first is the lowest triangle there.
typedef struct {
    size_t edge_count;
    MeshFault open;       // edges of one triangle
    MeshFault crowded;    // edges of more than two
    MeshFault turned;     // edges whose two triangles run along them in the same direction
    MeshFault pinched;    // points whose triangles form several fans
    MeshFault duplicates; // triangles with the corners of an earlier one, in any order
    bool is_closed;       // has triangles, and none of the first four faults
    bool is_inside_out;   // closed, with the fronts facing inwards
} Closedness;

bool closedness_find(Closedness *closedness, const Mesh *mesh, const Weld *weld, const Edges *edges,
                     Error *error);
