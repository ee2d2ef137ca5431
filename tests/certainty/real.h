// SPDX-License-Identifier: MIT
// Decides a pixel's ray tree in real arithmetic on the stored scene: in 64 bits if they suffice,
// else in 113. The code is independent of the kernels and uses other methods.
#pragma once

#include "certainty/real_tree.h"

typedef struct {
    const FlatScene *flat; // of pairs
    const RealTree *tree;
    const CameraData *camera;
    uint32_t width, height; // in samples
    uint32_t max_level;
} RealView;

typedef struct {
    bool settled;       // all decisions of the tree are beyond the arithmetic's error
    bool first_settled; // those at the first hit are
    uint32_t first_id;  // NOTHING where the camera ray meets nothing
    uint32_t lit;       // a bit for each of the first 32 lights that shine on the first hit
    uint32_t signature; // of all decisions, as certify.cl mixes them
} RealDecisions;

// Decide the sample in that column and row.
RealDecisions real_decide_64(const RealView *view, uint32_t column, uint32_t row);
RealDecisions real_decide_113(const RealView *view, uint32_t column, uint32_t row);

// In the fewest bits that settle everything; those of the most where none do.
RealDecisions real_decide(const RealView *view, uint32_t column, uint32_t row);
