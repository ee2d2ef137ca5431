// SPDX-License-Identifier: MIT
// FlatScene -> SceneTraits: what the scene contains, as the switches of kernels/config.h.
// A program specialized by them holds no code for what the scene lacks; every such program draws
// the same picture as the general one.
#pragma once

#include "accel/flat.h"

typedef struct {
    bool spheres, triangles;
    bool bvh;        // triangles are found through the tree
    bool mirrors;    // a material in use reflects
    bool shaded;     // a material in use is shaded by lights: more than silhouettes
    bool statistics; // rays and tests are counted
} SceneTraits;

SceneTraits traits_of(const FlatScene *flat, bool statistics);

// The program that renders every scene; counting is a matter of asking, not of the scene.
SceneTraits traits_general(bool statistics);

#define TRAITS_OPTIONS_SIZE 160

// The compiler options that set the switches, as a string of less than TRAITS_OPTIONS_SIZE bytes.
void traits_write_options(const SceneTraits *traits, char options[TRAITS_OPTIONS_SIZE]);
