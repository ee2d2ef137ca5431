// SPDX-License-Identifier: MIT
// A model: a signed field, and the box in which the field is sampled. The field is negative inside,
// and its magnitude approximates the distance to the surface. It must be positive on the box's
// faces, so that the surface is closed.
#pragma once

#include "base/vec.h"

typedef double Field(Vec3 point);

// The color of the surface at a point, components in [0, 1].
typedef Vec3 PointColor(Vec3 point);

typedef struct {
    const char *name; // the file is NAME.ply
    Field *field;
    PointColor *color; // NULL for models without colors
    Vec3 low, high;    // the box that holds the surface, before the taper
    double cell;       // edge of a grid cell at z = 0: about the edge of a triangle
    double taper; // per unit of height in the box, cells shrink by this fraction of their size at
                  // z = 0, so that higher parts have finer triangles
} Model;

extern const Model model_creature, model_figure, model_coral, model_vase;
