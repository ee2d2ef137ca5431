// SPDX-License-Identifier: MIT
// Scene and Bvh -> FlatScene: the arrays the device reads (kernels/shared.h), and nothing for what
// the scene does not contain.
#pragma once

#include "accel/bvh.h"

typedef struct {
    PointLight *lights;
    Material *materials;
    SphereData *spheres;
    BvhPair *nodes;          // none without triangles or without a tree
    TriangleData *triangles; // in the order of the leaves
    CornerNormals *normals;  // of the smooth triangles, in file order
    uint32_t light_count, material_count, sphere_count;
    uint32_t node_count, triangle_count, normals_count;
    float background[3], ambient;
} FlatScene;

// A bvh without nodes gives a scene whose triangles are all tested.
bool flat_make(FlatScene *flat, const Scene *scene, const Triangles *triangles, const Bvh *bvh,
               Error *error);
void flat_free(FlatScene *flat);

// Bytes of all arrays: what goes to the device.
size_t flat_size(const FlatScene *flat);
