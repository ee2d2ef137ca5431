// SPDX-License-Identifier: MIT
// Collapses the binary tree into nodes of up to eight children. A wide node starts with a binary
// node's two children or a large leaf's two halves. While the node has fewer than eight children,
// its divisible child of largest surface area, which rays hit most often, is replaced by the
// child's two parts. A child with at most eight leaves is divided only if all its leaves fit. This
// rule avoids nodes of only two or three blocks. One thread walks the tree, and then all threads
// fill the blocks. Nodes and blocks are in depth-first order.
#include "accel/flat_parts.h"

#include <stdlib.h>
#include <string.h>

// A candidate for a child of a wide node: a binary node, or a range of a leaf's triangles, which
// may exceed one block.
typedef struct {
    Box box;
    float area;
    uint32_t node;
    uint32_t first, count; // range of a leaf's triangles in Bvh::order
    uint32_t leaf_count;
} Part;

// The triangles [first, first + count) of Bvh::order or, without a tree, of the file.
typedef struct {
    uint32_t first, count;
} Range;

typedef struct {
    FlatScene *flat;
    const FlatSource *source;
    BvhWide *wides; // flat->node_count nodes so far; the rest is unused
    Range *blocks;  // flat->block_count ranges so far; the rest is unused
} Collapse;

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
// leaf's range is halved at a multiple of WIDE triangles.
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

// Returns whether to open a part of a node that has room for `room` more parts. A node's only part
// is always opened, unless the part is a block.
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

// Opens parts[0] and the resulting parts repeatedly. Returns the number of parts.
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

static void fill_block(const Collapse *collapse, TriangleBlock *block, Range range)
{
    const FlatScene *flat = collapse->flat;
    const Triangles *triangles = collapse->source->triangles;
    const uint32_t *order = collapse->source->bvh->order;
    if (range.count < WIDE)
        memset(block, 0, sizeof *block);
    for (uint32_t i = 0; i < range.count; i++) {
        const uint32_t triangle = order == NULL ? range.first + i : order[range.first + i];
        const CornerOrder *sorted = triangles_order(triangles, triangle);
        for (int corner = 0; corner < 3; corner++) {
            const float *point = triangles_corner(triangles, triangle, sorted->places[corner]);
            for (int axis = 0; axis < 3; axis++)
                block->corners[corner][axis][i] = point[axis];
        }
        block->id[i] =
            (flat->sphere_count + triangle) | (flat->looks[triangle].material & TRIANGLE_MARKS);
    }
    for (uint32_t i = range.count; i < WIDE; i++)
        block->id[i] = NOTHING;
}

static void fill_blocks(void *context, uint32_t first, uint32_t end)
{
    const Collapse *collapse = context;
    for (uint32_t number = first; number < end; number++)
        fill_block(collapse, &collapse->flat->blocks[number], collapse->blocks[number]);
}

static uint32_t add_block(const Collapse *collapse, uint32_t first, uint32_t count)
{
    const uint32_t number = collapse->flat->block_count++;
    collapse->blocks[number] = (Range){first, count};
    return WIDE_LEAF | number;
}

// Writes the wide node of a part and all nodes below. Returns the index of the part's node. The
// depth of the binary tree and the halving of large leaves bound the recursion.
static uint32_t write_node(const Collapse *collapse, const Part *part)
{
    Part parts[WIDE] = {*part};
    const uint32_t number = collapse->flat->node_count++;
    BvhWide *wide = &collapse->wides[number];
    memset(wide->padding, 0, sizeof wide->padding);
    wide->child_count = gather_children(collapse->source->bvh, parts);
    for (uint32_t child = 0; child < wide->child_count; child++) {
        const Part *own = &parts[child];
        box_store(wide->planes[0][0], WIDE, child, &own->box);
        wide->child[child] =
            is_block(own) ? add_block(collapse, own->first, own->count) : write_node(collapse, own);
    }
    for (uint32_t child = wide->child_count; child < WIDE; child++) {
        box_store(wide->planes[0][0], WIDE, child, NULL);
        wide->child[child] = 0;
    }
    return number;
}

// Without a tree, blocks hold the triangles in file order.
static void list_blocks(const Collapse *collapse)
{
    const uint32_t count = collapse->flat->triangle_count;
    for (uint32_t first = 0; first < count; first += WIDE)
        add_block(collapse, first, count - first < WIDE ? count - first : WIDE);
}

static bool make_all(const Collapse *collapse, Error *error)
{
    FlatScene *flat = collapse->flat;
    if (collapse->wides == NULL || collapse->blocks == NULL)
        return false;
    if (collapse->source->bvh->node_count > 0) {
        const Part root = part_of(collapse->source->bvh, 0);
        write_node(collapse, &root);
    } else {
        list_blocks(collapse);
    }
    flat->wides = memory_raw(flat->node_count, sizeof *flat->wides, error);
    flat->blocks = memory_raw(flat->block_count, sizeof *flat->blocks, error);
    if (flat->wides == NULL || flat->blocks == NULL)
        return false;
    memcpy(flat->wides, collapse->wides, flat->node_count * sizeof *flat->wides);
    thread_pool_share(collapse->source->pool, flat->block_count, CHUNK_ELEMENTS / WIDE, fill_blocks,
                      (void *)collapse);
    return true;
}

static void unmark_chunk(void *context, uint32_t first, uint32_t end)
{
    const FlatScene *flat = context;
    for (uint32_t i = first; i < end; i++)
        flat->looks[i].material &= ~TRIANGLE_MARKS;
}

// A leaf of n triangles makes at most n / WIDE + 1 blocks. Each wide node replaces an inner node or
// covers blocks of one leaf.
bool flat_wide_make(FlatScene *flat, const FlatSource *source, Error *error)
{
    const size_t leaves = source->bvh->leaf_count, inner = source->bvh->node_count - leaves;
    const size_t blocks = leaves + flat->triangle_count / WIDE + 1;
    Collapse collapse = {flat, source, NULL, NULL};
    collapse.wides = memory_sparse(inner + blocks, sizeof(BvhWide), error);
    collapse.blocks = memory_sparse(blocks, sizeof(Range), error);
    const bool ok = make_all(&collapse, error);
    free(collapse.wides);
    free(collapse.blocks);
    if (ok)
        thread_pool_share(source->pool, flat->triangle_count, CHUNK_ELEMENTS, unmark_chunk, flat);
    return ok;
}
