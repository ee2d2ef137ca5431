// SPDX-License-Identifier: MIT
// Mesh -> the sizes of its finest details, measured in steps between floats. Rounding distorts
// details that are only a few steps long. Edges are measured both in the file's coordinates and in
// normalized coordinates.
#pragma once

#include "scene/normalize.h"

// The smallest edge or height of all triangles, in steps. A step is the distance between
// neighboring floats at the triangle's largest coordinate.
typedef struct {
    double steps; // the length in steps; INFINITY if there is no such edge or height
    double size;  // the length in the scene's units
    size_t triangle;
} Feature;

typedef struct {
    Feature edge;         // shortest edge, in normalized coordinates
    Feature height;       // lowest height of triangles with an area, in normalized coordinates
    Feature written_edge; // shortest edge, in the file's coordinates
    bool holds_floats;    // floats represent every coordinate exactly
    MeshFault flat;       // triangles without area: three corners on a line
    double extent;        // largest side of the mesh's bounds
    double offset;        // largest coordinate of the bounds' center, in magnitude
} Features;

Features features_of(const Mesh *mesh, const Normalization *normalization);

// The next two functions fail if there are triangles without area. The message names the file of
// the first object with such triangles, its first such triangle and the count.

// Fails if the reader dropped a triangle with two equal corners.
bool features_check_dropped(const Scene *scene, Error *error);

// Fails if any triangle, even a dropped one, has no area.
bool features_check_areas(const Scene *scene, Error *error);
