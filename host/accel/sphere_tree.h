// SPDX-License-Identifier: MIT
// Spheres of a FlatScene -> a tree of bounding spheres over them (Rubin and Whitted, 1980). A ray
// skips all spheres in a bounding sphere that it provably does not meet.
#pragma once

#include "accel/flat_scene.h"

// Up to this number of spheres, rays test each sphere.
// Measure: trace of `clrt SCENE --tune kernel=packet,bvh=none --repeat 50 --json`, divided by the
// trace with bvh=sah.
#define TREELESS_SPHERES 12

// Appends the tree to flat->spheres, and sets flat->sphere_entries.
bool sphere_tree_make(FlatScene *flat, Error *error);
