// SPDX-License-Identifier: MIT
// Intersects rays with a scene's triangles in fp64, by the method of Moeller and Trumbore ("Fast,
// minimum storage ray-triangle intersection", 1997). Blocks of successive triangles have a layout
// that compilers vectorize. There is no tree: a ray skips the blocks whose bounding sphere it
// misses, and tests all triangles of the other blocks.
#pragma once

#include "scene/scene.h"

// The points origin + t * direction with near < t < far.
typedef struct {
    Vec3 origin, direction; // direction has length 1
    double near, far;
    uint32_t own; // id of the primitive that the ray starts on; NOTHING for none
} OracleRay;

typedef struct {
    double t; // INFINITY before the first hit
    uint32_t id;
} OracleHit;

#define BLOCK_SIZE 16

typedef struct {
    double x[BLOCK_SIZE], y[BLOCK_SIZE], z[BLOCK_SIZE];
} VectorColumns;

typedef struct {
    VectorColumns corner, first, second; // a corner, and the two edges from this corner
    double least[BLOCK_SIZE]; // the least determinant of a hit; 0 if the back is invisible
    uint32_t ids[BLOCK_SIZE];
    uint32_t count;
    Vec3 center; // the bounding sphere
    double radius;
} OracleBlock;

typedef struct {
    OracleBlock *data; // count blocks; owned
    size_t count;
} OracleBlocks;

bool blocks_make(OracleBlocks *blocks, const Scene *scene, Error *error);
void blocks_free(OracleBlocks *blocks);

// Replaces hit if a triangle is nearer, or is at the same distance with a lower id.
void blocks_meet(const OracleBlocks *blocks, const OracleRay *ray, OracleHit *hit);

// Returns whether the ray hits any triangle other than its own.
bool blocks_block(const OracleBlocks *blocks, const OracleRay *ray);
