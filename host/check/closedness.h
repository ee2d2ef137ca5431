// SPDX-License-Identifier: MIT
// Edges -> whether a mesh is closed: every edge has two consistently oriented triangles, and the
// triangles around each point form one fan.
#pragma once

#include "mesh/edges.h"

// Each MeshFault counts edges, points or triangles. Its field `first` is a triangle at a fault.
typedef struct {
    size_t edge_count;
    MeshFault open;       // edges of one triangle
    MeshFault crowded;    // edges of more than two triangles
    MeshFault turned;     // edges that both triangles run along in the same direction
    MeshFault pinched;    // points whose triangles form several fans
    MeshFault duplicates; // triangles with the corners of an earlier one, in any order
    bool is_closed;       // the mesh has triangles, and none of the first four faults
    bool is_inside_out;   // the mesh is closed, and the fronts face inwards
} Closedness;

bool closedness_find(Closedness *closedness, const Mesh *mesh, const Weld *weld, const Edges *edges,
                     Error *error);
