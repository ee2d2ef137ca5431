// SPDX-License-Identifier: MIT
// Derives SceneTraits, the switches of kernels/config.h, from a FlatScene. A program specialized by
// them has no code for unused features. It renders the same picture as the general program.
#pragma once

#include "accel/flat.h"

typedef struct {
    bool spheres, triangles;
    bool bvh;        // rays find triangles with a tree
    bool mirrors;    // a used material reflects
    bool shaded;     // a used material is more than a silhouette
    bool statistics; // the kernels count rays and tests
} SceneTraits;

SceneTraits traits_of(const FlatScene *flat, bool statistics);

// Returns the traits of the program that renders every scene. statistics is the user's choice and
// does not depend on the scene.
SceneTraits traits_general(bool statistics);

#define TRAITS_OPTIONS_SIZE 160

// Writes the compiler options that set the switches, as a zero-terminated string.
void traits_write_options(const SceneTraits *traits, char options[TRAITS_OPTIONS_SIZE]);
