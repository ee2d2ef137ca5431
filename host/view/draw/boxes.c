// SPDX-License-Identifier: MIT
// The depth of the tree bounds the recursion.
#include "view/draw/draw.h"

#include <stdlib.h>

typedef struct {
    Boxes *boxes;
    const Bvh *bvh;
    uint32_t level; // 0 for leaves; the root is at 1
    Error *error;
} Collection;

static bool collect(const Collection *collection, uint32_t number, uint32_t level)
{
    const BvhNode *node = &collection->bvh->nodes[number];
    const bool is_leaf = node->count > 0;
    if (is_leaf ? collection->level == 0 : collection->level == level)
        return array_push(collection->boxes, node->box, collection->error);
    return is_leaf || (collect(collection, node->first, level + 1) &&
                       collect(collection, node->first + 1, level + 1));
}

uint32_t boxes_levels(const Bvh *bvh)
{
    return bvh->depth > 0 ? bvh->depth - 1 : 0;
}

bool boxes_make(Boxes *boxes, const Bvh *bvh, uint32_t level, Error *error)
{
    const Collection collection = {boxes, bvh, level, error};
    return bvh->node_count == 0 || collect(&collection, 0, 1);
}

void boxes_free(Boxes *boxes)
{
    free(boxes->memory);
    *boxes = (Boxes){0};
}
