// SPDX-License-Identifier: MIT
// Flattens a Scene and its Bvh into the arrays that the device reads (kernels/shared.h). Features
// that the scene lacks take no memory.
#pragma once

#include "accel/bvh.h"

// The memory layout of triangles and their tree. Both layouts render the same picture.
typedef enum {
    NODES_PAIR, // two children per node, single triangles: suits GPUs
    NODES_WIDE, // up to eight children per node, blocks of eight slots: for vector instructions
    NODE_LAYOUTS
} NodeLayout;

typedef struct {
    NodeLayout layout;
    PointLight *lights;
    Material *materials;
    SphereData *spheres;
    BvhPair *pairs;          // NODES_PAIR only: the tree
    TriangleData *triangles; // NODES_PAIR only: in leaf order
    BvhWide *wides;          // NODES_WIDE only: the tree
    TriangleBlock *blocks;   // NODES_WIDE only: in leaf order
    TriangleLook *looks;     // NODES_WIDE only: in file order
    CornerNormals *normals;  // of smooth triangles, in file order
    uint32_t light_count, material_count, sphere_count;
    uint32_t node_count; // entries of pairs or wides
    uint32_t triangle_count, block_count, normals_count;
    float background[3], ambient;
} FlatScene;

// The input of flattening. If bvh has no nodes, the kernels test every triangle.
typedef struct {
    const Scene *scene;
    const Triangles *triangles;
    const Bvh *bvh;
    const Normalization *normalization; // of the scene
    NodeLayout layout;
    ThreadPool *pool; // NULL for the caller's thread only
} FlatSource;

// Returns the unit in which leaves of this layout are tested.
BvhLeaves flat_leaves(NodeLayout layout);

bool flat_make(FlatScene *flat, const FlatSource *source, Error *error);
void flat_free(FlatScene *flat);

// An array as the kernels read it.
typedef struct {
    const char *name; // for users
    const void *data;
    size_t bytes; // 0 if the array is empty
} FlatArray;

#define FLAT_ARRAYS 7

// Lists the arrays in the order of the kernels' arguments: lights, materials, spheres, nodes,
// triangles, looks and normals.
void flat_arrays(const FlatScene *flat, FlatArray arrays[FLAT_ARRAYS]);

// The input of scene_compile, which runs all stages: triangles, tree and flattening.
typedef struct {
    const Scene *scene;
    const Normalization *normalization; // of the scene
    NodeLayout layout;
    BvhBuilder builder;
    bool has_tree;    // false: rays test every triangle
    ThreadPool *pool; // NULL for the caller's thread only
} CompileSource;

// The intermediate results of scene_compile.
typedef struct {
    Triangles triangles;
    Bvh bvh;
} CompileStages;

// Fills *flat, which must be {0}, and *stages unless stages is NULL. The caller always frees both.
bool scene_compile(FlatScene *flat, CompileStages *stages, const CompileSource *source,
                   Error *error);
void compile_stages_free(CompileStages *stages);

// The features that a scene uses, as the switches of kernels/config.h. A program specialized by
// them has no code for unused features. It renders the same picture as the general program.
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
