// SPDX-License-Identifier: MIT
// Collapses a binary tree into nodes of up to eight children (compare Wald, Benthin and Boulos,
// "Getting rid of packets", 2008). A wide node starts with the two children of a binary node, or
// with the two halves of a large leaf. While the node has fewer than eight children, its largest
// divisible child is replaced by the two parts of this child. The largest child is the one with the
// largest surface area, which rays hit most often. A child with at most eight leaves is divided
// only if the node has room for all these leaves. This rule makes nodes of only two or three blocks
// rare. Nodes and blocks are in depth-first order.
#include "accel/wide_tree.h"

#include <stdlib.h>
#include <string.h>

static float largest_coordinate(const Box *box)
{
    float largest = 0;
    for (int axis = 0; axis < 3; axis++)
        largest = fmaxf(largest, fmaxf(fabsf(box->low[axis]), fabsf(box->high[axis])));
    return largest;
}

static float rounded_down(double value)
{
    const float nearest = (float)value;
    return (double)nearest <= value ? nearest : nextafterf(nearest, -INFINITY);
}

static float rounded_up(double value)
{
    return -rounded_down(-value);
}

// The new planes are nearly exact in fp64, and are then rounded outward to float.
Box box_grow(const Box *box, float share)
{
    const double slack = (double)share * (double)largest_coordinate(box);
    Box grown;
    for (int axis = 0; axis < 3; axis++) {
        grown.low[axis] = rounded_down((double)box->low[axis] - slack);
        grown.high[axis] = rounded_up((double)box->high[axis] + slack);
    }
    return grown;
}

void box_store(float *planes, uint32_t children, uint32_t child, const Box *box)
{
    const Box grown =
        box != NULL ? box_grow(box, BVH_SLACK)
                    : (Box){{0x1p100f, 0x1p100f, 0x1p100f}, {-0x1p100f, -0x1p100f, -0x1p100f}};
    for (uint32_t axis = 0; axis < 3; axis++) {
        planes[2 * axis * children + child] = grown.low[axis];
        planes[(2 * axis + 1) * children + child] = grown.high[axis];
    }
}

// Returns half the surface area; zero for an empty box.
static float box_half_area(const Box *box)
{
    const float x = box->high[0] - box->low[0];
    const float y = box->high[1] - box->low[1];
    const float z = box->high[2] - box->low[2];
    return x >= 0 ? x * y + y * z + z * x : 0;
}

// A candidate for a child of a wide node: a binary node, or a range of a leaf's items. This
// range may exceed one block.
typedef struct {
    Box box;
    float area;
    uint32_t node;
    uint32_t first, count; // range of a leaf's items in Bvh::order
    uint32_t leaf_count;
} Part;

static bool is_block(const Part *part)
{
    return part->count > 0 && part->count <= WIDE;
}

static Part part_of(const Bvh *bvh, uint32_t number)
{
    const BvhNode *node = &bvh->nodes[number];
    Part part = {.box = node->box,
                 .area = box_half_area(&node->box),
                 .node = number,
                 .leaf_count = node->leaf_count};
    if (node->count > 0) {
        part.first = node->first;
        part.count = node->count;
    }
    return part;
}

// Opens *part and stores the result in *part and *second. An inner node becomes its two children. A
// leaf's range is halved at a multiple of WIDE items.
static void open_part(const Bvh *bvh, Part *part, Part *second)
{
    const Part whole = *part;
    if (whole.count == 0) {
        const uint32_t child = bvh->nodes[whole.node].first;
        *part = part_of(bvh, child);
        *second = part_of(bvh, child + 1);
        return;
    }
    const uint32_t blocks = (whole.count + WIDE - 1) / WIDE;
    part->count = (blocks + 1) / 2 * WIDE;
    *second = whole;
    second->first += part->count;
    second->count -= part->count;
}

// Returns whether to open a part of a wide node that has room for `room` more parts. A node's only
// part is always opened, unless it is a block.
static bool can_open(const Part *part, uint32_t room)
{
    return !is_block(part) &&
           (part->leaf_count > WIDE || part->leaf_count <= room + 1 || room + 1 == WIDE);
}

static int largest_part(const Part *parts, uint32_t count)
{
    int largest = -1;
    for (uint32_t i = 0; i < count; i++)
        if (can_open(&parts[i], WIDE - count) &&
            (largest < 0 || parts[i].area > parts[largest].area))
            largest = (int)i;
    return largest;
}

// Opens parts[0] and then always the largest part, until the node is full or can_open allows no
// part. Returns the number of parts.
static uint32_t gather_children(const Bvh *bvh, Part parts[WIDE])
{
    uint32_t count = 1;
    while (count < WIDE) {
        const int largest = largest_part(parts, count);
        if (largest < 0)
            break;
        open_part(bvh, &parts[largest], &parts[count]);
        count++;
    }
    return count;
}

static uint32_t add_block(WideTree *tree, uint32_t first, uint32_t count)
{
    tree->blocks[tree->block_count] = (ItemRange){first, count};
    return tree->leaf_bits | tree->block_count++;
}

// Writes the wide node of a part and all nodes below it. Returns the index of the part's node. The
// recursion is bounded, because the binary tree has a largest depth and large leaves are halved.
static uint32_t write_node(WideTree *tree, const Part *part)
{
    Part parts[WIDE] = {*part};
    BvhWide *wide = &tree->nodes[tree->node_count];
    const uint32_t number = tree->root + tree->node_count++;
    memset(wide->padding, 0, sizeof wide->padding);
    wide->child_count = gather_children(tree->bvh, parts);
    for (uint32_t child = 0; child < wide->child_count; child++) {
        const Part *own = &parts[child];
        box_store(wide->planes[0][0], WIDE, child, &own->box);
        wide->child[child] =
            is_block(own) ? add_block(tree, own->first, own->count) : write_node(tree, own);
    }
    for (uint32_t child = wide->child_count; child < WIDE; child++) {
        box_store(wide->planes[0][0], WIDE, child, NULL);
        wide->child[child] = 0;
    }
    return number;
}

// Reserves enough memory for all nodes and blocks. A leaf of n items makes at most n / WIDE + 1
// blocks. Each wide node replaces an inner node of the tree or covers blocks of one leaf.
bool wide_tree_make(WideTree *tree, uint32_t item_count, Error *error)
{
    const size_t leaves = tree->bvh->leaf_count, inner = tree->bvh->node_count - leaves;
    const size_t blocks = leaves + item_count / WIDE + 1;
    tree->nodes = memory_sparse(inner + blocks, sizeof *tree->nodes, error);
    tree->blocks = memory_sparse(blocks, sizeof *tree->blocks, error);
    if (tree->nodes == NULL || tree->blocks == NULL)
        return false;
    if (tree->bvh->node_count > 0) {
        const Part root = part_of(tree->bvh, 0);
        write_node(tree, &root);
        return true;
    }
    for (uint32_t first = 0; first < item_count; first += WIDE)
        add_block(tree, first, item_count - first < WIDE ? item_count - first : WIDE);
    return true;
}

void wide_tree_free(WideTree *tree)
{
    free(tree->nodes);
    free(tree->blocks);
    tree->nodes = NULL;
    tree->blocks = NULL;
}
