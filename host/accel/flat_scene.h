// SPDX-License-Identifier: MIT
// The arrays that the device reads (kernels/shared.h), in host memory.
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
    SphereData *spheres;     // sphere_entries entries
    BvhPair *pairs;          // NODES_PAIR only: the tree
    TriangleData *triangles; // NODES_PAIR only: in leaf order
    BvhWide *wides;          // NODES_WIDE only: the tree
    TriangleBlock *blocks;   // NODES_WIDE only: in leaf order
    TriangleLook *looks;     // NODES_WIDE only: in file order
    CornerNormals *normals;  // of smooth triangles, in file order
    CornerColors *colors;    // of colored triangles, in file order
    uint32_t light_count, material_count, sphere_count;
    uint32_t sphere_entries; // sphere_count, or more with a tree over the spheres
    uint32_t sphere_root;    // NODES_WIDE only: the root of this tree, or NOTHING
    uint32_t node_count;     // entries of pairs or wides
    uint32_t triangle_count, block_count, normals_count, colors_count;
    float background[3], ambient;
    Box bounds; // of all primitives, grown by SKY_SLACK; unspecified if there are none
} FlatScene;

// The input of flattening. If `bvh` has no nodes, the kernels test every triangle.
typedef struct {
    const Scene *scene;
    const Triangles *triangles; // NULL: scene_compile makes triangles and tree
    const Bvh *bvh;
    const Normalization *normalization; // of the scene
    NodeLayout layout;
    ThreadPool *pool;   // NULL for the caller's thread only
    bool is_two_sided;  // all meshes are two-sided; else only glass, and objects with two_sided
    bool has_tree;      // false: rays test every triangle and every sphere
    BvhBuilder builder; // of trees that scene_compile makes
} FlatSource;
