// SPDX-License-Identifier: MIT
#include "accel/scene_compile.h"

#include "accel/flat.h"

static bool make_stages(CompileStages *stages, const FlatSource *source, Error *error)
{
    const BvhSettings settings = {source->builder, flat_leaves(source->layout)};
    return triangles_make(&stages->triangles, source->scene, source->normalization, source->pool,
                          error) &&
           (!source->has_tree ||
            bvh_build(&stages->bvh, &stages->triangles, &settings, source->pool, error));
}

bool scene_compile(FlatScene *flat, CompileStages *stages, const FlatSource *source, Error *error)
{
    static const Bvh none;
    FlatSource complete = *source;
    *stages = (CompileStages){0};
    if (source->triangles == NULL) {
        if (!make_stages(stages, source, error))
            return false;
        complete.triangles = &stages->triangles;
        complete.bvh = &stages->bvh;
    }
    if (!source->has_tree)
        complete.bvh = &none;
    return flat_make(flat, &complete, error);
}

void compile_stages_free(CompileStages *stages)
{
    triangles_free(&stages->triangles);
    bvh_free(&stages->bvh);
}
