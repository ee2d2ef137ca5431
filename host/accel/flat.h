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
