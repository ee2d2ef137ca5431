// SPDX-License-Identifier: MIT
// Unless the caller sets one_sided, compiles all meshes as two-sided, so that rays also hit their
// triangles from behind.
#include "session/ray_scene.h"

#include <stdlib.h>

void ray_scene_free(RayScene *ray_scene)
{
    scene_form_free(&ray_scene->form);
    free(ray_scene->places);
    *ray_scene = (RayScene){0};
}

static bool compile(RayScene *ray_scene, const Session *session, NodeLayout layout, bool one_sided,
                    Error *error)
{
    const bool has_tree =
        session->settings.wanted.tree != CLRT_TREE_NONE && session_wants_tree(session, layout);
    const FlatSource source = {.scene = session->scene.scene,
                               .normalization = &session->scene.normalization,
                               .layout = layout,
                               .is_two_sided = !one_sided,
                               .has_tree = has_tree};
    if (!session_compile(session, &source, &ray_scene->form, error))
        return false;
    bvh_free(&ray_scene->form.stages.bvh); // frees memory early
    return true;
}

// Lists the triangles of all meshes.
static void name_triangles(TrianglePlace *places, const Scene *scene)
{
    for (uint32_t mesh = 0; mesh < scene->objects.count; mesh++) {
        const Mesh *named = &scene->objects.data[mesh].mesh;
        for (size_t i = 0; i < named->triangle_count; i++)
            *places++ = (TrianglePlace){NOTHING, mesh, (uint32_t)mesh_original_number(named, i)};
    }
}

static bool find_places(RayScene *ray_scene, const Scene *scene, Error *error)
{
    const FlatScene *flat = &ray_scene->form.flat;
    const uint32_t spheres = flat->sphere_count;
    TrianglePlace *places = memory_raw(flat->triangle_count, sizeof *places, error);
    ray_scene->places = places;
    if (places == NULL)
        return false;
    name_triangles(places, scene);
    for (uint32_t i = 0; flat->layout == NODES_PAIR && i < flat->triangle_count; i++)
        places[flat->triangles[i].id - spheres].index = i;
    for (uint32_t i = 0; i < flat->block_count * WIDE; i++) {
        const uint32_t word = flat->blocks[i / WIDE].id[i % WIDE];
        if (word != NOTHING)
            places[(word & ~TRIANGLE_MARKS) - spheres].index = i;
    }
    return true;
}

bool ray_scene_take(RayScene *ray_scene, Session *session, NodeLayout layout, bool one_sided,
                    Error *error)
{
    if (ray_scene->is_loaded && ray_scene->one_sided == one_sided)
        return true;
    ray_scene_free(ray_scene);
    const bool ok = compile(ray_scene, session, layout, one_sided, error) &&
                    find_places(ray_scene, session->scene.scene, error) &&
                    scene_buffers_make(&ray_scene->form.buffers, &session->device,
                                       &ray_scene->form.flat, error);
    if (!ok)
        ray_scene_free(ray_scene);
    ray_scene->is_loaded = ok;
    ray_scene->one_sided = one_sided;
    return ok;
}
