// SPDX-License-Identifier: MIT
// Compiles the session's scene. Each form is compiled when a kernel first requires it.
#include "accel/sphere_tree.h"
#include "session/costs.h"
#include "session/session.h"

#include <stdlib.h>

bool session_scene_take(Session *session, const Scene *scene, Error *error)
{
    session_scene_free(&session->scene);
    session->scene.scene = scene;
    session->scene.normalization = normalization_of(scene);
    return normalization_check(&session->scene.normalization, scene, error);
}

void session_scene_free(SessionScene *scene)
{
    for (size_t i = 0; i < scene->pieces.count; i++)
        mesh_pieces_free(&scene->pieces.data[i]);
    free(scene->pieces.data);
    for (int layout = 0; layout < NODE_LAYOUTS; layout++)
        for (int has_tree = 0; has_tree < 2; has_tree++)
            scene_form_free(&scene->forms[layout][has_tree]);
    *scene = (SessionScene){0};
}

bool session_scene_wants_tree(const Session *session, NodeLayout layout)
{
    const Scene *scene = session->scene.scene;
    return session->settings.wanted.tree != CLRT_TREE_AUTO || layout != NODES_WIDE ||
           scene_triangle_count(scene) > TREELESS_TRIANGLES ||
           scene->spheres.count > TREELESS_SPHERES;
}

void scene_form_free(SceneForm *form)
{
    scene_buffers_free(&form->buffers);
    flat_free(&form->flat);
    compile_stages_free(&form->stages);
}

bool session_scene_compile(const Session *session, const FlatSource *source, SceneForm *form,
                           Error *error)
{
    FlatSource complete = *source;
    complete.builder = session_scene_builder(&session->settings.wanted);
    complete.pool = thread_pool_open(session->settings.wanted.threads);
    const bool ok = scene_compile(&form->flat, &form->stages, &complete, error);
    thread_pool_close(complete.pool);
    if (!ok)
        scene_form_free(form);
    return ok;
}

static bool make_form(Session *session, SceneForm *form, NodeLayout layout, bool has_tree,
                      Error *error)
{
    const SessionScene *scene = &session->scene;
    const CompileStages *stages = scene->stages;
    const FlatSource source = {.scene = scene->scene,
                               .triangles = stages != NULL ? &stages->triangles : NULL,
                               .bvh = stages != NULL ? &stages->bvh : NULL,
                               .normalization = &scene->normalization,
                               .layout = layout,
                               .has_tree = has_tree};
    if (!session_scene_compile(session, &source, form, error))
        return false;
    Bvh counts = form->stages.bvh;
    counts.nodes = NULL;
    counts.order = NULL;
    compile_stages_free(&form->stages);
    form->stages.bvh = counts;
    return true;
}

SceneForm *session_scene_form(Session *session, NodeLayout layout, bool has_tree, Error *error)
{
    const bool uses_tree = has_tree && session_scene_wants_tree(session, layout);
    SceneForm *form = &session->scene.forms[layout][uses_tree];
    const bool is_made = form->flat.lights != NULL;
    return is_made || make_form(session, form, layout, uses_tree, error) ? form : NULL;
}

SceneForm *session_scene_own_form(Session *session, Error *error)
{
    return session_scene_form(session, session->choice.nodes,
                              session->settings.wanted.tree != CLRT_TREE_NONE, error);
}

bool session_scene_find_pieces(Session *session, Error *error)
{
    SessionScene *scene = &session->scene;
    while (scene->pieces.count < scene->scene->objects.count) {
        MeshPieces pieces;
        if (!mesh_pieces_make(&pieces, &scene->scene->objects.data[scene->pieces.count].mesh,
                              error))
            return false;
        if (!array_push(&scene->pieces, pieces, error)) {
            mesh_pieces_free(&pieces);
            return false;
        }
    }
    return true;
}

BvhBuilder session_scene_builder(const ClrtSettings *settings)
{
    return settings->tree == CLRT_TREE_MIDPOINT ? BVH_MIDPOINT : BVH_SAH;
}
