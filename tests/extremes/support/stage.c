// SPDX-License-Identifier: MIT
// The stages in their order.
#include "stage.h"

#include "check.h"
#include "image/form.h"
#include "plain_tree.h"

const char *const tree_names[TREE_ALL_KINDS] = {"sah",      "midpoint", "none",     "leaves_1",
                                                "leaves_2", "leaves_4", "leaves_8", "deepest"};

static bool build_tree(Bvh *bvh, const Triangles *triangles, TreeKind tree, NodeLayout layout,
                       Error *error)
{
    const BvhBuilder builder = tree == TREE_MIDPOINT ? BVH_MIDPOINT : BVH_SAH;
    const BvhSettings settings = {builder, flat_leaves(layout)};
    if (tree == TREE_NONE)
        return true;
    if (tree < TREE_KINDS)
        return bvh_build(bvh, triangles, &settings, NULL, error);
    if (tree == TREE_DEEPEST)
        plain_tree_chain(bvh, triangles);
    else
        plain_tree_halves(bvh, triangles, 1u << (tree - TREE_LEAVES_1));
    return true;
}

void stage_make_as(Stage *stage, const Scene *scene, TreeKind tree, NodeLayout layout)
{
    Error error = {0};
    *stage = (Stage){.normalization = normalization_of(scene)};
    const FlatSource source = {scene, &stage->triangles, &stage->bvh, &stage->normalization, layout,
                               NULL};
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

StageTriangle stage_triangle(const Triangles *triangles, size_t number)
{
    StageTriangle triangle;
    for (int corner = 0; corner < 3; corner++)
        for (int axis = 0; axis < 3; axis++)
            triangle.corners[corner][axis] = triangles_corner(triangles, number, corner)[axis];
    return triangle;
}
