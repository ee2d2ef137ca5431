// SPDX-License-Identifier: MIT
// A model: a signed field (negative inside, about a distance) and the box in which it is sampled.
// The field must be positive on the box's faces, so that the surface is closed.
#pragma once

#include "base/vec.h"

typedef double Field(Vec3 point);

typedef struct {
    const char *name; // the file is NAME.ply
    Field *field;
    Vec3 low, high; // the box that holds the surface, before the taper
    double cell;    // edge of a grid cell at z = 0: about the edge of a triangle
    double taper;   // fraction of their size by which cells shrink per unit of height before the
                    // taper, so that higher parts have finer triangles
} Model;

extern const Model model_creature, model_figure, model_coral;
