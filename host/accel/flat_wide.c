// SPDX-License-Identifier: MIT
// Collapses the binary tree: a wide node starts with a binary node's two children and opens the one
// with the largest surface, the likeliest to be met, until it has eight.  Nodes are written depth
// first, and so are the blocks.
#include "accel/flat_wide.h"

#include "accel/box.h"
#include "accel/slack.h"

#include <stdlib.h>
#include <string.h>

// A part of the tree that is to become a child: a node, or some of the triangles of a leaf that is
// too large for one block.
typedef struct {
    Box box;
    uint32_t node;         // NOTHING for triangles
    uint32_t first, count; // places of the order
} Part;

typedef struct {
    FlatScene *flat;
    const FlatSource *source;
} Collapse;

static Part part_of(const Bvh *bvh, uint32_t number)
{
    const BvhNode *node = &bvh->nodes[number];
    if (node->count > 0)
        return (Part){node->box, NOTHING, node->first, node->count};
    return (Part){.box = node->box, .node = number};
}

static bool is_block(const Part *part)
{
    return part->node == NOTHING && part->count <= WIDE;
}

// Replaces a part by its halves.
static void open_part(const Bvh *bvh, Part *part, Part *second)
{
    const Part whole = *part;
    if (whole.node != NOTHING) {
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

static int largest_part(const Part *parts, uint32_t count)
{
    int largest = -1;
    for (uint32_t i = 0; i < count; i++)
        if (!is_block(&parts[i]) &&
            (largest < 0 || box_half_area(&parts[i].box) > box_half_area(&parts[largest].box)))
            largest = (int)i;
    return largest;
}

// Turns one part into up to eight.
static uint32_t gather_children(const Bvh *bvh, Part parts[WIDE])
{
    uint32_t count = 1;
    for (int largest = 0; count < WIDE; count++) {
        largest = largest_part(parts, count);
        if (largest < 0)
            break;
        open_part(bvh, &parts[largest], &parts[count]);
    }
    return count;
}

static void write_planes(BvhWide *wide, uint32_t child, const Box *box)
{
    const Box grown = slack_grow(box);
    for (int axis = 0; axis < 3; axis++) {
        wide->planes[axis][0][child] = grown.low[axis];
        wide->planes[axis][1][child] = grown.high[axis];
    }
}

// No ray is ever between these planes.
static void write_missing(BvhWide *wide, uint32_t child)
{
    for (int axis = 0; axis < 3; axis++) {
        wide->planes[axis][0][child] = 0x1p100f;
        wide->planes[axis][1][child] = -0x1p100f;
    }
}

// Appends a block of the triangles at places [first, first + count) of the order.
static uint32_t write_block(const Collapse *collapse, uint32_t first, uint32_t count)
{
    FlatScene *flat = collapse->flat;
    const uint32_t *order = collapse->source->bvh->order;
    TriangleBlock *block = &flat->blocks[flat->block_count];
    memset(block, 0, sizeof *block);
    for (uint32_t i = 0; i < WIDE; i++)
        block->id[i] = NOTHING;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t number = order == NULL ? first + i : order[first + i];
        for (int corner = 0; corner < 3; corner++)
            for (int axis = 0; axis < 3; axis++)
                block->corners[corner][axis][i] =
                    collapse->source->triangles->corners[number][corner][axis];
        block->id[i] =
            (flat->sphere_count + number) | (flat->looks[number].material & TRIANGLE_TWO_SIDED);
    }
    return flat->block_count++;
}

// Recursion is bounded by the levels of the binary tree.
static uint32_t write_node(const Collapse *collapse, const Part *part)
{
    Part parts[WIDE] = {*part};
    FlatScene *flat = collapse->flat;
    const uint32_t number = flat->node_count++;
    BvhWide *wide = &flat->wides[number];
    memset(wide, 0, sizeof *wide);
    wide->child_count = gather_children(collapse->source->bvh, parts);
    for (uint32_t child = 0; child < wide->child_count; child++) {
        write_planes(wide, child, &parts[child].box);
        if (is_block(&parts[child]))
            wide->child[child] =
                WIDE_LEAF | write_block(collapse, parts[child].first, parts[child].count);
    }
    for (uint32_t child = wide->child_count; child < WIDE; child++)
        write_missing(wide, child);
    for (uint32_t child = 0; child < wide->child_count; child++)
        if (!is_block(&parts[child]))
            wide->child[child] = write_node(collapse, &parts[child]);
    return number;
}

static uint32_t blocks_for(uint32_t triangle_count)
{
    return (triangle_count + WIDE - 1) / WIDE;
}

static uint32_t count_blocks(const Bvh *bvh, uint32_t number)
{
    const BvhNode *node = &bvh->nodes[number];
    if (node->count > 0)
        return blocks_for(node->count);
    return count_blocks(bvh, node->first) + count_blocks(bvh, node->first + 1);
}

// Gives back what a generous estimate took too much; failing to is no harm.
static void *trimmed(void *memory, size_t size)
{
    void *smaller = realloc(memory, size > 0 ? size : 1);
    return smaller != NULL ? smaller : memory;
}

bool flat_wide_make(FlatScene *flat, const FlatSource *source, Error *error)
{
    const Collapse collapse = {flat, source};
    const Bvh *bvh = source->bvh;
    const bool has_tree = bvh->node_count > 0;
    const uint32_t blocks = has_tree ? count_blocks(bvh, 0) : blocks_for(flat->triangle_count);
    // Each wide node but a lone one stands for at least one binary node between blocks.
    flat->wides = memory_raw(has_tree ? blocks : 0, sizeof *flat->wides, error);
    flat->blocks = memory_raw(blocks, sizeof *flat->blocks, error);
    if (flat->wides == NULL || flat->blocks == NULL)
        return false;
    if (has_tree) {
        const Part root = part_of(bvh, 0);
        write_node(&collapse, &root);
    }
    for (uint32_t first = 0; !has_tree && first < flat->triangle_count; first += WIDE)
        write_block(&collapse, first,
                    flat->triangle_count - first < WIDE ? flat->triangle_count - first : WIDE);
    for (uint32_t i = 0; i < flat->triangle_count; i++)
        flat->looks[i].material &= ~TRIANGLE_TWO_SIDED;
    flat->wides = trimmed(flat->wides, flat->node_count * sizeof *flat->wides);
    return true;
}
