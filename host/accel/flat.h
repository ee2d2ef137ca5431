// SPDX-License-Identifier: MIT
// Flattens a Scene and its Bvh into the arrays that the device reads (kernels/shared.h). Features
// that the scene lacks take no memory.
#pragma once

#include "accel/flat_scene.h"

// Returns how the kernels for this layout test a leaf: triangle by triangle, or in blocks.
BvhLeaves flat_leaves(NodeLayout layout);

bool flat_make(FlatScene *flat, const FlatSource *source, Error *error);
void flat_free(FlatScene *flat);

// An array that the kernels read.
typedef struct {
    const char *name; // for users
    const void *data;
    size_t bytes; // 0 if the array is empty
} FlatArray;

#define FLAT_ARRAYS 8

// Lists the arrays in the order of the kernels' arguments: lights, materials, spheres, nodes,
// triangles, looks, normals and colors.
void flat_arrays(const FlatScene *flat, FlatArray arrays[FLAT_ARRAYS]);

// The intermediate results of scene_compile.
typedef struct {
    Triangles triangles;
    Bvh bvh;
} CompileStages;

// Runs all stages: triangles, tree and flattening. Fills *flat, which must be {0}. Also fills
// *stages, unless the source has triangles. The caller frees both, even after a failure.
bool scene_compile(FlatScene *flat, CompileStages *stages, const FlatSource *source, Error *error);
void compile_stages_free(CompileStages *stages);

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
float flat_reflectivity(const FlatScene *flat);

// Returns the traits of the general program for scenes with the traits `needed`. The program has
// all traits that are not rare, and the rare traits in `needed`. With glass, it also has checkers.
SceneTraits traits_general(SceneTraits needed);

#define TRAITS_OPTIONS_SIZE 192

// Writes the compiler options that set the switches, as a zero-terminated string.
void traits_write_options(const SceneTraits *traits, char options[TRAITS_OPTIONS_SIZE]);
