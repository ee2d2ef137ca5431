// SPDX-License-Identifier: MIT
// Runs the stages in their order, with trees of all kinds.
#include "stage.h"

#include "check.h"
#include "image/form.h"
#include "shapes.h"

const char *const tree_names[TREE_ALL_KINDS] = {"sah",      "midpoint", "none",     "leaves_1",
                                                "leaves_2", "leaves_4", "leaves_8", "deepest"};

// The triangles [first, first + count) of a subtree.
typedef struct {
    uint32_t node, first, count, level;
} Part;

typedef struct {
    Bvh *bvh;
    const Triangles *triangles;
    TreeKind kind; // TREE_LEAVES_1 or later
} Making;

static bool is_leaf(const Making *making, const Part *part)
{
    if (making->kind == TREE_DEEPEST)
        return part->count == 1 || part->level == BVH_MAX_DEPTH;
    return part->count <= 1u << (making->kind - TREE_LEAVES_1);
}

static Box make_leaf(Making *making, const Part *part)
{
    Box box = box_empty();
    Bvh *bvh = making->bvh;
    for (uint32_t i = 0; i < 3 * part->count; i++) {
        const float *point = triangles_corner(making->triangles, part->first + i / 3, (int)(i % 3));
        box_include(&box, point, point);
    }
    bvh->nodes[part->node] = (BvhNode){box, part->first, part->count};
    bvh->leaf_count++;
    if (part->count > bvh->largest_leaf)
        bvh->largest_leaf = part->count;
    if (part->level > bvh->depth)
        bvh->depth = part->level;
    return box;
}

// Makes the subtree, and returns its box. The recursion is as deep as the tree.
static Box make_node(Making *making, Part part)
{
    Bvh *bvh = making->bvh;
    if (is_leaf(making, &part))
        return make_leaf(making, &part);
    const uint32_t children = bvh->node_count;
    const uint32_t half = making->kind == TREE_DEEPEST ? 1 : part.count / 2;
    bvh->node_count += 2;
    const Part first = {children, part.first, half, part.level + 1};
    const Part second = {children + 1, part.first + half, part.count - half, part.level + 1};
    Box box = make_node(making, first);
    const Box other = make_node(making, second);
    box_include(&box, other.low, other.high);
    bvh->nodes[part.node] = (BvhNode){box, children, 0};
    return box;
}

static void make_plain_tree(Bvh *bvh, const Triangles *triangles, TreeKind kind)
{
    const uint32_t count = (uint32_t)triangles->count;
    *bvh = (Bvh){.node_count = 1};
    bvh->nodes = require_memory(2 * (size_t)count, sizeof *bvh->nodes);
    bvh->order = require_memory(count, sizeof *bvh->order);
    for (uint32_t i = 0; i < count; i++)
        bvh->order[i] = i;
    make_node(&(Making){bvh, triangles, kind}, (Part){0, 0, count, 1});
}

static bool build_tree(Bvh *bvh, const Triangles *triangles, TreeKind tree, NodeLayout layout,
                       Error *error)
{
    const BvhBuilder builder = tree == TREE_MIDPOINT ? BVH_MIDPOINT : BVH_SAH;
    const BvhSettings settings = {builder, flat_leaves(layout)};
    if (tree == TREE_NONE)
        return true;
    if (tree < TREE_KINDS)
        return bvh_build(bvh, triangles, &settings, NULL, error);
    make_plain_tree(bvh, triangles, tree);
    return true;
}

void stage_make_as(Stage *stage, const Scene *scene, TreeKind tree, NodeLayout layout)
{
    Error error = {0};
    *stage = (Stage){.normalization = normalization_of(scene)};
    const FlatSource source = {.scene = scene,
                               .triangles = &stage->triangles,
                               .bvh = &stage->bvh,
                               .normalization = &stage->normalization,
                               .layout = layout,
                               .has_tree = tree != TREE_NONE};
    const bool ok = normalization_check(&stage->normalization, scene, &error) &&
                    triangles_make(&stage->triangles, scene, &stage->normalization, NULL, &error) &&
                    build_tree(&stage->bvh, &stage->triangles, tree, layout, &error) &&
                    flat_make(&stage->flat, &source, &error);
    require(ok, &error);
}

void stage_make(Stage *stage, const Scene *scene, TreeKind tree)
{
    stage_make_as(stage, scene, tree, form_choice().nodes);
}

void stage_free(Stage *stage)
{
    flat_free(&stage->flat);
    bvh_free(&stage->bvh);
    triangles_free(&stage->triangles);
    *stage = (Stage){0};
}

Vec3 corner_of(const Triangles *triangles, size_t triangle, size_t corner)
{
    return vec3_of_floats(triangles_corner(triangles, triangle, (int)corner));
}

static Vec3 edge_of(const Triangles *triangles, size_t triangle, size_t corner)
{
    return vec3_sub(corner_of(triangles, triangle, corner), corner_of(triangles, triangle, 0));
}

Vec3 point_of(const Triangles *triangles, size_t triangle, double u, double v)
{
    const Vec3 along = vec3_scale(edge_of(triangles, triangle, 1), u);
    const Vec3 across = vec3_scale(edge_of(triangles, triangle, 2), v);
    return vec3_add(corner_of(triangles, triangle, 0), vec3_add(along, across));
}

Vec3 normal_of(const Triangles *triangles, size_t triangle)
{
    return vec3_normalize(
        vec3_cross(edge_of(triangles, triangle, 1), edge_of(triangles, triangle, 2)));
}
