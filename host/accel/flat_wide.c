// SPDX-License-Identifier: MIT
// Collapses the binary tree into nodes of up to eight children. A wide node starts with a binary
// node's two children. It then opens children until it has eight: each time, two parts replace the
// child with the largest surface area, which rays most likely hit. A child with at most eight
// leaves is opened only if all its leaves fit. Otherwise, a node of only two or three blocks could
// remain. One thread walks the upper levels of the tree and lists the subtrees below them, called
// branches. All threads then compute the size of each branch, and later write each branch at its
// position. Nodes and blocks are in depth-first order.
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

// Numbers of nodes and blocks: a size, or a position in both arrays.
typedef struct {
    uint32_t nodes, blocks;
} Extent;

// A subtree of wide nodes just below the upper levels.
typedef struct {
    Part part;
    Extent extent; // its size, later its position
} Branch;

typedef struct {
    FlatScene *flat;
    const FlatSource *source;
    ARRAY(Branch) branches;
} Collapse;

// A traversal: of the upper levels down to the branches, or of one branch down to its blocks.
typedef struct {
    Collapse *collapse;
    bool is_upper;
    Extent next;
    uint32_t next_branch;
} Walk;

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

// Opens *part and stores the result in *part and *second. An inner node becomes its two children, a
// leaf's triangles become two halves of whole blocks.
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
// is always opened, unless it is a block.
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

static int compare_numbers(const void *first, const void *second)
{
    const uint32_t *a = first, *b = second;
    return (*a > *b) - (*a < *b);
}

// Returns whether the part is a branch, where a walk through the upper levels ends.
static bool is_branch(const Walk *walk, const Part *part)
{
    const Bvh *bvh = walk->collapse->source->bvh;
    if (!walk->is_upper || bvh->upper_count == 0)
        return walk->is_upper;
    return bsearch(&part->node, bvh->upper, bvh->upper_count, sizeof part->node, compare_numbers) ==
           NULL;
}

// Counts the part's nodes and blocks in walk->next, or lists the part as a branch. The depth of the
// binary tree bounds the recursion.
static bool count_node(Walk *walk, const Part *part, Error *error)
{
    Collapse *collapse = walk->collapse;
    Part parts[WIDE] = {*part};
    if (is_branch(walk, part))
        return array_push(&collapse->branches, (Branch){.part = *part}, error);
    const uint32_t count = gather_children(collapse->source->bvh, parts);
    bool ok = true;
    walk->next.nodes++;
    for (uint32_t child = 0; ok && child < count; child++)
        if (is_block(&parts[child]))
            walk->next.blocks++;
        else
            ok = count_node(walk, &parts[child], error);
    return ok;
}

// Fills block `number` with the triangles at [first, first + count) of Bvh::order or, without a
// tree, of the file.
static void fill_block(const Collapse *collapse, uint32_t number, uint32_t first, uint32_t count)
{
    const FlatScene *flat = collapse->flat;
    const Triangles *triangles = collapse->source->triangles;
    const uint32_t *order = collapse->source->bvh->order;
    TriangleBlock *block = &flat->blocks[number];
    if (count < WIDE)
        memset(block, 0, sizeof *block);
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t triangle = order == NULL ? first + i : order[first + i];
        const CornerOrder *sorted = triangles_order(triangles, triangle);
        for (int corner = 0; corner < 3; corner++) {
            const float *point = triangles_corner(triangles, triangle, sorted->places[corner]);
            for (int axis = 0; axis < 3; axis++)
                block->corners[corner][axis][i] = point[axis];
        }
        block->id[i] =
            (flat->sphere_count + triangle) | (flat->looks[triangle].material & TRIANGLE_MARKS);
    }
    for (uint32_t i = count; i < WIDE; i++)
        block->id[i] = NOTHING;
}

// Writes a block and returns its value for BvhWide::child.
static uint32_t write_block(Walk *walk, uint32_t first, uint32_t count)
{
    fill_block(walk->collapse, walk->next.blocks, first, count);
    return WIDE_LEAF | walk->next.blocks++;
}

// Writes the part's nodes and blocks, unless it is a branch. Returns the index of its first node.
static uint32_t write_node(Walk *walk, const Part *part)
{
    const Collapse *collapse = walk->collapse;
    Part parts[WIDE] = {*part};
    if (is_branch(walk, part))
        return collapse->branches.data[walk->next_branch++].extent.nodes;
    const uint32_t number = walk->next.nodes++;
    BvhWide *wide = &collapse->flat->wides[number];
    memset(wide->padding, 0, sizeof wide->padding);
    wide->child_count = gather_children(collapse->source->bvh, parts);
    for (uint32_t child = 0; child < wide->child_count; child++) {
        box_store(wide->planes[0][0], WIDE, child, &parts[child].box);
        if (is_block(&parts[child]))
            wide->child[child] = write_block(walk, parts[child].first, parts[child].count);
        else
            wide->child[child] = write_node(walk, &parts[child]);
    }
    for (uint32_t child = wide->child_count; child < WIDE; child++) {
        box_store(wide->planes[0][0], WIDE, child, NULL);
        wide->child[child] = 0;
    }
    return number;
}

static void count_branch(void *context, uint32_t number, uint32_t worker)
{
    Collapse *collapse = context;
    Branch *branch = &collapse->branches.data[number];
    Walk walk = {.collapse = collapse};
    Error none = {0}; // only walks through upper levels allocate memory
    (void)worker;
    count_node(&walk, &branch->part, &none);
    branch->extent = walk.next;
}

static void write_branch(void *context, uint32_t number, uint32_t worker)
{
    Collapse *collapse = context;
    const Branch *branch = &collapse->branches.data[number];
    Walk walk = {.collapse = collapse, .next = branch->extent};
    (void)worker;
    write_node(&walk, &branch->part);
}

// Turns the branches' sizes into positions. `next` is behind the upper nodes and their blocks.
static void place_branches(Collapse *collapse, Extent next)
{
    for (size_t i = 0; i < collapse->branches.count; i++) {
        Branch *branch = &collapse->branches.data[i];
        const Extent extent = branch->extent;
        branch->extent = next;
        next.nodes += extent.nodes;
        next.blocks += extent.blocks;
    }
    collapse->flat->node_count = next.nodes;
    collapse->flat->block_count = next.blocks;
}

static bool allocate(FlatScene *flat, Error *error)
{
    flat->wides = memory_raw(flat->node_count, sizeof *flat->wides, error);
    flat->blocks = memory_raw(flat->block_count, sizeof *flat->blocks, error);
    return flat->wides != NULL && flat->blocks != NULL;
}

static bool collapse_tree(Collapse *collapse, Error *error)
{
    ThreadPool *pool = collapse->source->pool;
    // Without upper levels, the root is a branch. It becomes a node even if it is a single block.
    const Part root = part_of(collapse->source->bvh, 0);
    Walk upper = {.collapse = collapse, .is_upper = true};
    if (!count_node(&upper, &root, error))
        return false;
    const uint32_t branches = (uint32_t)collapse->branches.count;
    thread_pool_run(pool, branches, count_branch, collapse);
    place_branches(collapse, upper.next);
    if (!allocate(collapse->flat, error))
        return false;
    upper.next = (Extent){0};
    write_node(&upper, &root);
    thread_pool_run(pool, branches, write_branch, collapse);
    return true;
}

static void write_list_chunk(void *context, uint32_t first, uint32_t end)
{
    const Collapse *collapse = context;
    for (; first < end; first += WIDE)
        fill_block(collapse, first / WIDE, first, end - first < WIDE ? end - first : WIDE);
}

static bool write_list(Collapse *collapse, Error *error)
{
    FlatScene *flat = collapse->flat;
    flat->block_count = (flat->triangle_count + WIDE - 1) / WIDE;
    if (!allocate(flat, error))
        return false;
    thread_pool_share(collapse->source->pool, flat->triangle_count, CHUNK_ELEMENTS,
                      write_list_chunk, collapse);
    return true;
}

static void unmark_chunk(void *context, uint32_t first, uint32_t end)
{
    const FlatScene *flat = context;
    for (uint32_t i = first; i < end; i++)
        flat->looks[i].material &= ~TRIANGLE_MARKS;
}

bool flat_wide_make(FlatScene *flat, const FlatSource *source, Error *error)
{
    Collapse collapse = {.flat = flat, .source = source};
    const bool ok = source->bvh->node_count > 0 ? collapse_tree(&collapse, error)
                                                : write_list(&collapse, error);
    free(collapse.branches.memory);
    if (ok)
        thread_pool_share(source->pool, flat->triangle_count, CHUNK_ELEMENTS, unmark_chunk, flat);
    return ok;
}
