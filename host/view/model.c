// SPDX-License-Identifier: MIT
// Runs the stages of the pipeline that need no device: reading the scene, normalization, triangles
// and tree.
#include "view/model.h"

#include <stdlib.h>

static bool load(Model *model, const SceneLoadOptions *options, uint32_t threads, Error *error)
{
    Error cause = {0};
    const char *path = model->path;
    if (!scn_load(&model->scene, path, options, error))
        return false;
    model->normalization = normalization_of(&model->scene);
    if (!normalization_check(&model->normalization, &model->scene, &cause))
        return error_set(error, "%s: %s", path, cause.text);
    ThreadPool *pool = thread_pool_open(threads);
    const bool ok =
        triangles_make(&model->stages.triangles, &model->scene, &model->normalization, pool, error);
    thread_pool_close(pool);
    return ok;
}

Model *model_load(const char *path, const SceneLoadOptions *options, uint32_t threads, Error *error)
{
    Model *model = memory_zeroed(1, sizeof *model, error);
    if (model == NULL)
        return NULL;
    atomic_init(&model->holders, 1);
    model->path = path;
    if (load(model, options, threads, error))
        return model;
    model_release(model);
    return NULL;
}

bool model_build_tree(Model *model, const BvhSettings *settings, uint32_t threads, Error *error)
{
    ThreadPool *pool = thread_pool_open(threads);
    const bool ok = bvh_build(&model->stages.bvh, &model->stages.triangles, settings, pool, error);
    thread_pool_close(pool);
    return ok;
}

Model *model_hold(Model *model)
{
    atomic_fetch_add(&model->holders, 1);
    return model;
}

void model_release(Model *model)
{
    if (model == NULL || atomic_fetch_sub(&model->holders, 1) > 1)
        return;
    compile_stages_free(&model->stages);
    scene_free(&model->scene);
    free(model);
}
