// SPDX-License-Identifier: MIT
// Derives SceneTraits, the switches of kernels/config.h, from a FlatScene. A specialized program
// has no code for features that the scene lacks. Every such program renders the same picture as
// the general one.
#pragma once

#include "accel/flat.h"

typedef struct {
    bool spheres, triangles;
    bool bvh;        // a tree finds the triangles
    bool mirrors;    // a used material reflects
    bool shaded;     // lights shade a used material: more than silhouettes
    bool statistics; // rays and tests are counted
} SceneTraits;

SceneTraits traits_of(const FlatScene *flat, bool statistics);

// Returns the traits of the program that renders every scene. The user, not the scene, requests
// statistics.
SceneTraits traits_general(bool statistics);

#define TRAITS_OPTIONS_SIZE 160

// Writes the compiler options that set the switches, as a string of less than TRAITS_OPTIONS_SIZE
// bytes.
void traits_write_options(const SceneTraits *traits, char options[TRAITS_OPTIONS_SIZE]);
