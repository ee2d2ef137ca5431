// SPDX-License-Identifier: MIT
// Compiles the session's scene. Each form is compiled when a kernel first needs it.
#include "accel/sphere_tree.h"
#include "session/costs.h"
#include "session/session.h"

bool session_take(Session *session, const Scene *scene, Error *error)
{
    session_scene_free(&session->scene);
    session->scene.scene = scene;
    session->scene.normalization = normalization_of(scene);
    return normalization_check(&session->scene.normalization, scene, error);
}

void session_scene_free(SessionScene *scene)
{
    for (int layout = 0; layout < NODE_LAYOUTS; layout++)
        for (int has_tree = 0; has_tree < 2; has_tree++) {
            scene_buffers_free(&scene->forms[layout][has_tree].buffers);
            flat_free(&scene->forms[layout][has_tree].flat);
        }
    *scene = (SessionScene){0};
}

bool session_wants_tree(const Session *session, NodeLayout layout)
{
    const Scene *scene = session->scene.scene;
    return session->settings.wanted.tree != CLRT_TREE_AUTO || layout != NODES_WIDE ||
           scene_triangle_count(scene) > TREELESS_TRIANGLES ||
           scene->spheres.count > TREELESS_SPHERES;
}

bool session_compile(const Session *session, CompileSource *source, FlatScene *flat,
                     CompileStages *stages, Error *error)
{
    source->normalization = &session->scene.normalization;
    source->builder = session_builder(&session->settings.wanted);
    source->pool = thread_pool_open(threads_allowed(session->settings.wanted.threads));
    const bool ok = scene_compile(flat, stages, source, error);
    thread_pool_close(source->pool);
    return ok;
}

static bool make_form(Session *session, SceneForm *form, NodeLayout layout, bool has_tree,
                      Error *error)
{
    CompileStages stages = {0};
    CompileSource source = {.scene = session->scene.scene,
                            .given = session->scene.stages,
                            .layout = layout,
                            .has_tree = has_tree};
    const bool ok = session_compile(session, &source, &form->flat, &stages, error);
    form->tree = stages.bvh;
    form->tree.nodes = NULL;
    form->tree.order = NULL;
    compile_stages_free(&stages);
    if (!ok)
        flat_free(&form->flat);
    return ok;
}

SceneForm *session_form(Session *session, NodeLayout layout, bool has_tree, Error *error)
{
    const bool uses_tree = has_tree && session_wants_tree(session, layout);
    SceneForm *form = &session->scene.forms[layout][uses_tree];
    const bool is_made = form->flat.lights != NULL;
    return is_made || make_form(session, form, layout, uses_tree, error) ? form : NULL;
}

SceneForm *session_own_form(Session *session, Error *error)
{
    return session_form(session, session->choice.nodes,
                        session->settings.wanted.tree != CLRT_TREE_NONE, error);
}

BvhBuilder session_builder(const ClrtSettings *settings)
{
    return settings->tree == CLRT_TREE_MIDPOINT ? BVH_MIDPOINT : BVH_SAH;
}
