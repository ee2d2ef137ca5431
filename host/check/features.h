// SPDX-License-Identifier: MIT
// Mesh -> its finest details, in units of float spacing, as written and as traced.
#pragma once

#include "scene/normalize.h"

// Among all triangles' lengths of one kind, the length with the fewest steps. A step is the spacing
// of floats at the triangle's largest coordinate.
typedef struct {
    double steps; // the length in steps; INFINITY if there is no length
    double size;  // the length in the scene's units
    size_t triangle;
} Feature;

typedef struct {
    Feature edge;         // shortest edge, in normalized coordinates
    Feature height;       // lowest height, also there; triangles without area do not count
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
