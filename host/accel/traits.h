// SPDX-License-Identifier: MIT
// FlatScene -> the features that the scene uses, and the compiler options for kernels with these
// features.
#pragma once

#include "accel/flat_scene.h"

// The features that a scene uses, as the switches of kernels/config.h. A specialized program has no
// code for unused features, and renders the same picture as the general program.
typedef struct {
    bool spheres, triangles;
    bool bvh;        // rays find triangles, or spheres in NODES_WIDE, with a tree
    bool mirrors;    // a used material reflects
    bool shaded;     // a used material is shaded by lights
    bool colors;     // a mesh has vertex colors
    bool checkers;   // a used material has a checker
    bool glass;      // a used material is glass
    bool statistics; // the kernels count rays and tests
} SceneTraits;

// A member of SceneTraits.
typedef struct {
    const char *name;             // in explanations
    const char *option;           // the switch
    size_t offset;                // of the member
    const char *absent, *present; // reasons in explanations; NULL if they contain numbers
    bool is_rare;                 // general programs have it only for scenes that need it
} Trait;

#define TRAIT_COUNT 9
extern const Trait trait_table[TRAIT_COUNT];

bool trait_of(const SceneTraits *traits, const Trait *trait);

SceneTraits traits_of(const FlatScene *flat, bool statistics);

// Returns the largest reflectivity of the materials that primitives use.
float traits_reflectivity(const FlatScene *flat);

// Returns the traits of the general program for scenes with the traits `needed`. The program has
// all traits that are not rare, and the rare traits in `needed`. With glass, it also has checkers.
SceneTraits traits_general(SceneTraits needed);

#define TRAITS_OPTIONS_SIZE 192

// Writes the compiler options that set the switches, as a zero-terminated string.
void traits_write_options(const SceneTraits *traits, char options[TRAITS_OPTIONS_SIZE]);
