// SPDX-License-Identifier: MIT
// Spheres of a FlatScene -> a tree of bounding spheres over them (Rubin and Whitted, 1980). A ray
// skips all spheres in a bounding sphere that it provably does not meet.
#pragma once

#include "accel/flat_scene.h"

// Up to this number of spheres, rays test each sphere. To measure the gain of a tree, divide the
// trace time that `clrt SCENE --tune kernel=packet,bvh=none --repeat 50 --json` prints by the time
// with bvh=sah.
#define TREELESS_SPHERES 12

static inline bool flat_has_sphere_tree(const FlatScene *flat, const FlatSource *source)
{
    return source->has_tree && flat->sphere_count > TREELESS_SPHERES;
}

// Appends the tree for pair nodes to flat->spheres, and sets flat->sphere_entries.
bool sphere_tree_make(FlatScene *flat, Error *error);
