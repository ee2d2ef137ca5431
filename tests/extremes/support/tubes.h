// SPDX-License-Identifier: MIT
// Closed rings whose tubes have ridges, bumps, saddles or thin walls inside. No two parts of a ring
// touch or cross.
#pragma once

#include "shapes.h"

typedef enum {
    TUBE_RIDGES, // folds along the tube
    TUBE_BUMPS,  // vertices at random distances from the middle of the tube
    TUBE_SADDLES,
    TUBE_WALLS, // fins, about 200 times as high as thick
    TUBE_KINDS
} TubeKind;

extern const char *const tube_names[TUBE_KINDS];

// Returns a ring around the z axis. The middle of its tube is TUBE_MIDDLE away from the axis.
#define TUBE_MIDDLE 2.0
Mesh tube_mesh(TubeKind kind, Random *random);

// Returns a random point in the tube, near its middle.
Vec3 tube_inside(Random *random);
