// SPDX-License-Identifier: MIT
// Traverses the tree with an explicit stack, as the kernels do.
#include "accel/levels.h"

#include <string.h>

typedef struct {
    uint32_t node, depth;
} Visit;

void levels_count(const Bvh *bvh, uint32_t counts[BVH_MAX_DEPTH])
{
    Visit stack[BVH_STACK_SIZE] = {{0, 0}};
    uint32_t waiting = bvh->node_count > 0 ? 1 : 0;
    memset(counts, 0, BVH_MAX_DEPTH * sizeof *counts);
    while (waiting > 0) {
        const Visit visit = stack[--waiting];
        const BvhNode *node = &bvh->nodes[visit.node];
        if (node->count > 0)
            continue;
        counts[visit.depth]++;
        stack[waiting++] = (Visit){node->first, visit.depth + 1};
        stack[waiting++] = (Visit){node->first + 1, visit.depth + 1};
    }
}
