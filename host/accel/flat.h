// SPDX-License-Identifier: MIT
// Scene and Bvh -> FlatScene: the arrays the device reads (kernels/shared.h), and nothing for what
// the scene does not contain.
#pragma once

#include "accel/bvh.h"

// How triangles and their tree lie in memory; the picture is the same.
typedef enum {
    NODES_PAIR, // two children a node, triangles one by one: for GPUs and as the plain reading
    NODES_WIDE  // eight children a node, triangles in blocks of eight: for vector instructions
} NodeLayout;

typedef struct {
    NodeLayout layout;
    PointLight *lights;
    Material *materials;
    SphereData *spheres;
    BvhPair *pairs;          // of NODES_PAIR: none without triangles or without a tree
    TriangleData *triangles; // of NODES_PAIR: in the order of the leaves
    BvhWide *wides;          // of NODES_WIDE: none without triangles or without a tree
    TriangleBlock *blocks;   // of NODES_WIDE: in the order of the leaves
    TriangleLook *looks;     // of NODES_WIDE: in file order
    CornerNormals *normals;  // of the smooth triangles, in file order
    uint32_t light_count, material_count, sphere_count;
    uint32_t node_count; // of the layout's kind
    uint32_t triangle_count, block_count, normals_count;
    float background[3], ambient;
} FlatScene;

// What a scene is flattened from.  A bvh without nodes gives a scene whose triangles are all
// tested.
typedef struct {
    const Scene *scene;
    const Triangles *triangles;
    const Bvh *bvh;
    const Normalization *normalization; // of the scene
    NodeLayout layout;
    Crew *crew; // to share the work, NULL for none
} FlatSource;

// The leaves that suit a layout.
BvhLeaves flat_leaves(NodeLayout layout);

bool flat_make(FlatScene *flat, const FlatSource *source, Error *error);
void flat_free(FlatScene *flat);

// Bytes of all arrays: what goes to the device.
size_t flat_size(const FlatScene *flat);
