// SPDX-License-Identifier: MIT
// The pair layout stores the inner nodes of the binary tree in depth-first order.
//
// The wide layout collapses the binary tree into nodes of up to eight children (compare Wald,
// Benthin and Boulos, "Getting rid of packets", 2008). A wide node starts with the two children of
// a binary node, or with the two halves of a large leaf. While the node has fewer than eight
// children, its largest divisible child is replaced by the two parts of this child. The largest
// child is the one with the largest surface area, which rays hit most often. A child with at most
// eight leaves is divided only if the node has room for all these leaves. This rule makes nodes of
// only two or three blocks rare. Nodes and blocks are in depth-first order.
//
// One thread collapses the tree, and then all threads fill the blocks.
//
// Invariant: a stored box contains the triangles below it and a margin of BVH_SLACK around them.
// The kernels therefore never cull a triangle that their triangle test would accept
// (kernels/search.cl).
#include "accel/flat_nodes.h"

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

// Moves each plane of a box outward by `share` times the box's largest coordinate. The new planes
// are nearly exact in fp64, and are then rounded outward to float.
static Box box_grow(const Box *box, float share)
{
    const double slack = (double)share * (double)largest_coordinate(box);
    Box grown;
    for (int axis = 0; axis < 3; axis++) {
        grown.low[axis] = rounded_down((double)box->low[axis] - slack);
        grown.high[axis] = rounded_up((double)box->high[axis] + slack);
    }
    return grown;
}

// Stores a child's box, grown by BVH_SLACK, in the planes of a node with room for `children`
// children. If box is NULL, no ray enters the stored box. On each axis, the low planes of all
// children precede the high planes.
static void box_store(float *planes, uint32_t children, uint32_t child, const Box *box)
{
    const Box grown =
        box != NULL ? box_grow(box, BVH_SLACK)
                    : (Box){{0x1p100f, 0x1p100f, 0x1p100f}, {-0x1p100f, -0x1p100f, -0x1p100f}};
    for (uint32_t axis = 0; axis < 3; axis++) {
        planes[2 * axis * children + child] = grown.low[axis];
        planes[(2 * axis + 1) * children + child] = grown.high[axis];
    }
}

static void include_point(Box *box, const float point[3], float margin)
{
    for (int axis = 0; axis < 3; axis++) {
        box->low[axis] = fminf(box->low[axis], point[axis] - margin);
        box->high[axis] = fmaxf(box->high[axis], point[axis] + margin);
    }
}

Box flat_bounds(const FlatScene *flat, const FlatSource *source)
{
    Box box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    const bool has_tree = source->bvh->node_count > 0;
    if (has_tree)
        box = source->bvh->nodes[0].box;
    for (uint32_t i = 0; !has_tree && i < flat->triangle_count; i++)
        for (int corner = 0; corner < 3; corner++)
            include_point(&box, triangles_corner(source->triangles, i, corner), 0);
    for (uint32_t i = 0; i < flat->sphere_count; i++)
        include_point(&box, flat->spheres[i].center, flat->spheres[i].radius);
    return box_grow(&box, SKY_SLACK);
}

// Returns the number of pairs: one per inner node, and one if the root is a leaf.
static uint32_t pair_count(const Bvh *bvh)
{
    return bvh->node_count <= 1 ? bvh->node_count : bvh->node_count - bvh->leaf_count;
}

// Writes an inner node as pairs[number], followed by the nodes below it, depth first. Returns the
// number of pairs written so far.
static uint32_t write_inner(BvhPair *pairs, uint32_t number, const Bvh *bvh, const BvhNode *node)
{
    uint32_t count = number + 1;
    for (int side = 0; side < 2; side++) {
        const BvhNode *child = &bvh->nodes[node->first + (uint32_t)side];
        box_store(pairs[number].planes[0][0], 2, (uint32_t)side, &child->box);
        pairs[number].count[side] = child->count;
        pairs[number].first[side] = child->count > 0 ? child->first : count;
        if (child->count == 0)
            count = write_inner(pairs, count, bvh, child);
    }
    return count;
}

static void write_pairs(BvhPair *pairs, const Bvh *bvh)
{
    if (bvh->node_count == 0)
        return;
    if (bvh->nodes[0].count == 0) {
        write_inner(pairs, 0, bvh, &bvh->nodes[0]);
        return;
    }
    box_store(pairs[0].planes[0][0], 2, 0, &bvh->nodes[0].box);
    box_store(pairs[0].planes[0][0], 2, 1, NULL);
    pairs[0].first[0] = pairs[0].first[1] = 0;
    pairs[0].count[0] = bvh->nodes[0].count;
    pairs[0].count[1] = 1;
}

static void place_triangles(FlatScene *flat, const FlatSource *source)
{
    const Triangles *triangles = source->triangles;
    const uint32_t *order = source->bvh->order;
    for (uint32_t place = 0; place < flat->triangle_count; place++) {
        const uint32_t number = order == NULL ? place : order[place];
        TriangleData *triangle = &flat->triangles[place];
        triangle->id = flat->sphere_count + number;
        triangle->material = flat->looks[number].material;
        triangle->shading = flat->looks[number].shading;
        const uint8_t *corners = triangles_order(triangles, number)->places;
        memcpy(triangle->a, triangles_corner(triangles, number, corners[0]), sizeof triangle->a);
        memcpy(triangle->b, triangles_corner(triangles, number, corners[1]), sizeof triangle->b);
        memcpy(triangle->c, triangles_corner(triangles, number, corners[2]), sizeof triangle->c);
    }
}

bool flat_pair_make(FlatScene *flat, const FlatSource *source, Error *error)
{
    flat->node_count = pair_count(source->bvh);
    flat->pairs = memory_raw(flat->node_count, sizeof *flat->pairs, error);
    flat->triangles = memory_raw(flat->triangle_count, sizeof *flat->triangles, error);
    if (flat->pairs == NULL || flat->triangles == NULL)
        return false;
    write_pairs(flat->pairs, source->bvh);
    place_triangles(flat, source);
    free(flat->looks);
    flat->looks = NULL;
    return true;
}

// Returns half the surface area; zero for an empty box.
static float box_half_area(const Box *box)
{
    const float x = box->high[0] - box->low[0];
    const float y = box->high[1] - box->low[1];
    const float z = box->high[2] - box->low[2];
    return x >= 0 ? x * y + y * z + z * x : 0;
}

// A candidate for a child of a wide node: a binary node, or a range of a leaf's triangles. This
// range may exceed one block.
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
} TriangleRange;

typedef struct {
    FlatScene *flat;
    const FlatSource *source;
    BvhWide *wides;        // flat->node_count nodes so far; the rest is unused
    TriangleRange *blocks; // flat->block_count ranges so far; the rest is unused
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

// Returns whether to open a part. Its node has room for `room` more parts. If the node has no other
// part, the part is always opened, unless it is a block.
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

static void fill_block(const Collapse *collapse, TriangleBlock *block, TriangleRange range)
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
    collapse->blocks[number] = (TriangleRange){first, count};
    return WIDE_LEAF | number;
}

// Writes the wide node of a part and all nodes below it. Returns the index of the part's node. The
// recursion is bounded, because the binary tree has a largest depth and large leaves are halved.
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

// Lists the blocks of a scene without a tree, in file order.
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

// Reserves enough memory for all nodes and blocks. A leaf of n triangles makes at most n / WIDE + 1
// blocks. Each wide node replaces an inner node of the tree or covers blocks of one leaf.
bool flat_wide_make(FlatScene *flat, const FlatSource *source, Error *error)
{
    const size_t leaves = source->bvh->leaf_count, inner = source->bvh->node_count - leaves;
    const size_t blocks = leaves + flat->triangle_count / WIDE + 1;
    Collapse collapse = {flat, source, NULL, NULL};
    collapse.wides = memory_sparse(inner + blocks, sizeof(BvhWide), error);
    collapse.blocks = memory_sparse(blocks, sizeof(TriangleRange), error);
    const bool ok = make_all(&collapse, error);
    free(collapse.wides);
    free(collapse.blocks);
    if (ok)
        thread_pool_share(source->pool, flat->triangle_count, CHUNK_ELEMENTS, unmark_chunk, flat);
    return ok;
}
