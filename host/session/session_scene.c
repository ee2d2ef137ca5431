// SPDX-License-Identifier: MIT
// Compiles the session's scene. Each form is compiled when a kernel first needs it.
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
    const uint64_t triangles = scene_triangle_count(session->scene.scene);
    return session->settings.wanted.tree != CLRT_TREE_AUTO || layout != NODES_WIDE ||
           triangles > TREELESS_TRIANGLES;
}

static bool compile(const Session *session, SceneForm *form, CompileStages *stages,
                    const CompileSource *source, Error *error)
{
    const SessionScene *scene = &session->scene;
    const CompileStages *given = scene->stages;
    const Bvh none = {0};
    if (given == NULL)
        return scene_compile(&form->flat, stages, source, error);
    const FlatSource flat = {.scene = scene->scene,
                             .triangles = &given->triangles,
                             .bvh = source->has_tree ? &given->bvh : &none,
                             .normalization = &scene->normalization,
                             .layout = source->layout,
                             .pool = source->pool};
    return flat_make(&form->flat, &flat, error);
}

static bool make_form(Session *session, SceneForm *form, NodeLayout layout, bool has_tree,
                      Error *error)
{
    CompileStages stages = {0};
    const CompileSource source = {
        .scene = session->scene.scene,
        .normalization = &session->scene.normalization,
        .layout = layout,
        .builder = session_builder(&session->settings.wanted),
        .has_tree = has_tree,
        .pool = thread_pool_open(threads_allowed(session->settings.wanted.threads))};
    const bool ok = compile(session, form, &stages, &source, error);
    thread_pool_close(source.pool);
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
