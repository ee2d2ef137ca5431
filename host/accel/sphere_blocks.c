// SPDX-License-Identifier: MIT
// bvh_build_boxes makes the tree from the spheres' boxes, which are rounded outward.
#include "accel/sphere_blocks.h"

#include "accel/sphere_tree.h"

#include <stdlib.h>
#include <string.h>

static Box box_of(const SphereData *sphere)
{
    Box box;
    const double radius = (double)sphere->radius + (double)sphere->radius_low;
    for (int axis = 0; axis < 3; axis++) {
        const double center = (double)sphere->center[axis] + (double)sphere->center_low[axis];
        box.low[axis] = nextafterf((float)(center - radius), -INFINITY);
        box.high[axis] = nextafterf((float)(center + radius), INFINITY);
    }
    return box;
}

static bool build_bvh(Bvh *bvh, const FlatScene *flat, const FlatSource *source, Error *error)
{
    const BvhSettings settings = {source->builder, LEAVES_BLOCKS};
    Box *boxes = memory_raw(flat->sphere_count, sizeof *boxes, error);
    if (boxes == NULL)
        return false;
    for (uint32_t i = 0; i < flat->sphere_count; i++)
        boxes[i] = box_of(&flat->spheres[i]);
    const bool ok = bvh_build_boxes(bvh, &(BoxArray){boxes, flat->sphere_count}, &settings,
                                    source->pool, error);
    free(boxes);
    return ok;
}

static void fill_block(SphereBlock *block, const SphereData *spheres, const uint32_t *ids,
                       uint32_t count)
{
    memset(block, 0, sizeof *block);
    for (uint32_t slot = 0; slot < count; slot++) {
        const SphereData *sphere = &spheres[ids[slot]];
        for (int axis = 0; axis < 3; axis++) {
            block->center[axis][slot] = sphere->center[axis];
            block->center_low[axis][slot] = sphere->center_low[axis];
        }
        block->radius[slot] = sphere->radius;
        block->radius_low[slot] = sphere->radius_low;
        block->id[slot] = ids[slot];
    }
    for (uint32_t slot = count; slot < WIDE; slot++)
        block->id[slot] = NOTHING;
}

static bool append_blocks(FlatScene *flat, const WideTree *tree, Error *error)
{
    const uint32_t entries = flat->sphere_count + tree->block_count * SPHERE_BLOCK_ENTRIES;
    SphereData *spheres = memory_raw(entries, sizeof *spheres, error);
    if (spheres == NULL)
        return false;
    memcpy(spheres, flat->spheres, flat->sphere_count * sizeof *spheres);
    SphereBlock *blocks = (SphereBlock *)(spheres + flat->sphere_count);
    for (uint32_t i = 0; i < tree->block_count; i++)
        fill_block(&blocks[i], spheres, tree->bvh->order + tree->blocks[i].first,
                   tree->blocks[i].count);
    free(flat->spheres);
    flat->spheres = spheres;
    flat->sphere_entries = entries;
    return true;
}

bool sphere_blocks_make(FlatScene *flat, const FlatSource *source, WideTree *tree, Error *error)
{
    Bvh bvh = {0};
    if (!flat_has_sphere_tree(flat, source))
        return true;
    tree->bvh = &bvh;
    tree->leaf_bits = WIDE_SPHERES;
    const bool ok = build_bvh(&bvh, flat, source, error) &&
                    wide_tree_make(tree, flat->sphere_count, error) &&
                    append_blocks(flat, tree, error);
    flat->sphere_root = ok ? tree->root : NOTHING;
    bvh_free(&bvh);
    tree->bvh = NULL;
    return ok;
}
