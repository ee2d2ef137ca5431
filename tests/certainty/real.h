// SPDX-License-Identifier: MIT
// Returns the decisions that real arithmetic would make for all rays of a sample in the stored
// scene. Callers use numbers of 113 bits if numbers of 64 bits leave decisions unsettled. The code
// is independent of the kernels and uses other methods.
#pragma once

#include "certainty/real_tree.h"

typedef struct {
    const FlatScene *flat; // with pair nodes
    const RealTree *tree;
    const CameraData *camera;
    uint32_t width, height; // in samples
    uint32_t max_level;
} RealView;

typedef struct {
    bool settled;       // the error of the arithmetic cannot change any decision of the tree
    bool first_settled; // the error cannot change any decision at the first hit
    uint32_t first_id;  // NOTHING if the camera ray has no hit
    uint32_t lit;       // bit i: light i reaches the first hit, for the first 32 lights
    uint32_t signature; // a hash of all decisions, computed as in certify.cl
} RealDecisions;

// Return the decisions of the sample at column and row.
RealDecisions real_decide_64(const RealView *view, uint32_t column, uint32_t row);
RealDecisions real_decide_113(const RealView *view, uint32_t column, uint32_t row);
