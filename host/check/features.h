// SPDX-License-Identifier: MIT
// Mesh -> its smallest edge and triangle height, as written in the file and as traced. The unit is
// the spacing of floats.
#pragma once

#include "scene/normalize.h"

// The smallest length of one kind over all triangles. A step is the spacing of floats at the
// triangle's largest coordinate.
typedef struct {
    double steps; // the length in steps; INFINITY without triangles
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

// Returns whether the triangle's corners lie on one line, up to the rounding of fp64.
bool features_is_flat(const Mesh *mesh, size_t triangle);

Features features_of(const Mesh *mesh, const Normalization *normalization);
