// SPDX-License-Identifier: MIT
// Mesh -> how fine it is against the steps of the float coordinates that it is written and traced
// with.
#pragma once

#include "scene/normalize.h"

// A length of a triangle that is the shortest, in steps of float at the triangle's farthest
// coordinate.
typedef struct {
    double steps; // INFINITY without triangles
    double size;  // the length itself, in the scene's units
    size_t triangle;
} Feature;

typedef struct {
    Feature edge;         // in the frame that is traced
    Feature height;       // the same of triangles' heights, of those with an area
    Feature written_edge; // with the coordinates as they are, before they are centered
    bool holds_floats;    // every coordinate is a float
    MeshFault flat;       // triangles of no area: three corners on a line
    double extent;        // largest side of its bounds
    double offset;        // largest coordinate of their center
} Features;

// Whether the triangle's corners lie on one line, as far as fp64 tells.
bool features_is_flat(const Mesh *mesh, size_t triangle);

Features features_of(const Mesh *mesh, const Normalization *normalization);
