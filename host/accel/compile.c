// SPDX-License-Identifier: MIT
// The triangles and, for most callers, the tree are intermediate results.
#include "accel/compile.h"

bool scene_compile(FlatScene *flat, Bvh *bvh, const CompileSource *source, Error *error)
{
    Triangles triangles = {0};
    Bvh own = {0}, *tree = bvh != NULL ? bvh : &own;
    const BvhSettings settings = {source->builder, flat_leaves(source->layout)};
    const FlatSource stages = {.scene = source->scene,
                               .triangles = &triangles,
                               .bvh = tree,
                               .normalization = source->normalization,
                               .layout = source->layout,
                               .crew = source->crew};
    *tree = (Bvh){0};
    const bool ok =
        triangles_make(&triangles, source->scene, source->normalization, source->crew, error) &&
        (!source->has_tree || bvh_build(tree, &triangles, &settings, source->crew, error)) &&
        flat_make(flat, &stages, error);
    triangles_free(&triangles);
    bvh_free(&own);
    return ok;
}
