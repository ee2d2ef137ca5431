// SPDX-License-Identifier: MIT
// The triangles of a scene in fp64, 64 to a block, laid out so that a compiler can test several at
// once; and what a ray meets among them, by Moeller and Trumbore's method ("Fast, minimum storage
// ray-triangle intersection", 1997).  There is no tree: a block that a ray passes clear of its
// bounding sphere is left out, and every other triangle is tested.
#pragma once

#include "scene/scene.h"

// origin + t * direction for t above near and below far.
typedef struct {
    Vec3 origin, direction; // of length 1
    double near, far;
    uint32_t own; // id of the primitive it starts on, NOTHING for none
} OracleRay;

typedef struct {
    double t; // INFINITY while nothing is met
    uint32_t id;
} OracleHit;

#define BLOCK_SIZE 64

typedef struct {
    double x[BLOCK_SIZE], y[BLOCK_SIZE], z[BLOCK_SIZE];
} VectorColumns;

typedef struct {
    VectorColumns corner, first, second; // a corner and the edges from it to the other two
    double least[BLOCK_SIZE]; // determinants must be larger: 0 where the back is not seen
    uint32_t ids[BLOCK_SIZE];
    uint32_t count;
    Vec3 center; // of a sphere around all of them
    double radius;
} OracleBlock;

typedef struct {
    OracleBlock *data; // count of them, owned
    size_t count;
    bool tests_all; // no block is left out; to check that leaving out changes nothing
} OracleBlocks;

bool blocks_make(OracleBlocks *blocks, const Scene *scene, Error *error);
void blocks_free(OracleBlocks *blocks);

// Lowers hit to the nearest triangle before it, the lowest id among equals.
void blocks_meet(const OracleBlocks *blocks, const OracleRay *ray, OracleHit *hit);

// Whether the ray meets any triangle at all.
bool blocks_block(const OracleBlocks *blocks, const OracleRay *ray);
