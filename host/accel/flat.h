// SPDX-License-Identifier: MIT
// Flattens a Scene and its Bvh into the arrays that the device reads (kernels/shared.h). Features
// that the scene lacks take no memory.
#pragma once

#include "accel/bvh.h"

// The memory layout of triangles and their tree. The picture is the same for both.
typedef enum {
    NODES_PAIR, // two children per node, single triangles: for GPUs and for plain reading
    NODES_WIDE  // eight children per node, blocks of eight triangles: for vector instructions
} NodeLayout;

typedef struct {
    NodeLayout layout;
    PointLight *lights;
    Material *materials;
    SphereData *spheres;
    BvhPair *pairs;          // of NODES_PAIR: NULL without triangles or tree
    TriangleData *triangles; // of NODES_PAIR: in leaf order
    BvhWide *wides;          // of NODES_WIDE: NULL without triangles or tree
    TriangleBlock *blocks;   // of NODES_WIDE: in leaf order
    TriangleLook *looks;     // of NODES_WIDE: in file order
    CornerNormals *normals;  // of the smooth triangles, in file order
    uint32_t light_count, material_count, sphere_count;
    uint32_t node_count; // of the layout's kind
    uint32_t triangle_count, block_count, normals_count;
    float background[3], ambient;
} FlatScene;

// The input of flattening. With a bvh without nodes, the kernels test every triangle.
typedef struct {
    const Scene *scene;
    const Triangles *triangles;
    const Bvh *bvh;
    const Normalization *normalization; // of the scene
    NodeLayout layout;
    ThreadPool *pool; // threads for the work, NULL for none
} FlatSource;

// Returns the leaf unit that suits a layout.
BvhLeaves flat_leaves(NodeLayout layout);

bool flat_make(FlatScene *flat, const FlatSource *source, Error *error);
void flat_free(FlatScene *flat);

// Returns the bytes of all arrays, which are uploaded to the device.
size_t flat_size(const FlatScene *flat);
