// SPDX-License-Identifier: MIT
// Children take the next two free nodes.  Recursion is as deep as the tree.
#include "plain_tree.h"

#include "box_around.h"
#include "check.h"

// Triangles [first, first + count) become a node and all below it.
typedef struct {
    uint32_t node, first, count, level;
} Part;

typedef struct {
    Bvh *bvh;
    const Triangles *triangles;
    uint32_t leaf_size; // 0 for a chain
} Making;

static uint32_t first_half(const Making *making, const Part *part)
{
    if (making->leaf_size == 0)
        return 1;
    return part->count / 2;
}

static bool is_leaf(const Making *making, const Part *part)
{
    if (making->leaf_size == 0)
        return part->count == 1 || part->level == BVH_MAX_DEPTH;
    return part->count <= making->leaf_size;
}

static Box make_leaf(Making *making, const Part *part)
{
    Box box = box_empty();
    Bvh *bvh = making->bvh;
    for (uint32_t triangle = part->first; triangle < part->first + part->count; triangle++)
        for (int corner = 0; corner < 3; corner++)
            box_include_point(&box, triangles_corner(making->triangles, triangle, corner));
    bvh->nodes[part->node] = (BvhNode){box, part->first, part->count, 1};
    bvh->leaf_count++;
    if (part->count > bvh->largest_leaf)
        bvh->largest_leaf = part->count;
    if (part->level > bvh->depth)
        bvh->depth = part->level;
    return box;
}

static Box make_node(Making *making, Part part)
{
    Bvh *bvh = making->bvh;
    if (is_leaf(making, &part))
        return make_leaf(making, &part);
    const uint32_t children = bvh->node_count, half = first_half(making, &part);
    bvh->node_count += 2;
    const Part first = {children, part.first, half, part.level + 1};
    const Part second = {children + 1, part.first + half, part.count - half, part.level + 1};
    Box box = make_node(making, first);
    const Box other = make_node(making, second);
    box_include(&box, &other);
    bvh->nodes[part.node] = (BvhNode){
        box, children, 0, bvh->nodes[children].leaf_count + bvh->nodes[children + 1].leaf_count};
    return box;
}

static void make_tree(Bvh *bvh, const Triangles *triangles, uint32_t leaf_size)
{
    Error error = {0};
    const uint32_t count = (uint32_t)triangles->count;
    *bvh = (Bvh){.node_count = 1};
    if (count == 0) {
        bvh->node_count = 0;
        return;
    }
    bvh->nodes = memory_zeroed(2 * (size_t)count, sizeof *bvh->nodes, &error);
    bvh->order = memory_raw(count, sizeof *bvh->order, &error);
    require(bvh->nodes != NULL && bvh->order != NULL, &error);
    for (uint32_t i = 0; i < count; i++)
        bvh->order[i] = i;
    Making making = {bvh, triangles, leaf_size};
    make_node(&making, (Part){0, 0, count, 1});
}

void plain_tree_halves(Bvh *bvh, const Triangles *triangles, uint32_t leaf_size)
{
    make_tree(bvh, triangles, leaf_size);
}

void plain_tree_chain(Bvh *bvh, const Triangles *triangles)
{
    make_tree(bvh, triangles, 0);
}
