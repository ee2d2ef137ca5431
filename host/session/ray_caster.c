// SPDX-License-Identifier: MIT
// All launches of a kernel use work-groups of one size, because PoCL compiles a kernel again for
// each size.
#include "session/ray_caster.h"

#include "render/certifier.h"

#include <stdlib.h>

// Source files of kernels, embedded at build time.
extern const char rays_source[], certify_rays_source[];

#define ARGUMENTS "bnnnbb"

static const KernelEntry entries[RAY_QUERIES] = {
    [RAYS_NEAREST] = {"trace_rays", rays_source, "-DCLRT_RAYS=1", ARGUMENTS, .dimensions = 1},
    [RAYS_ALL] = {"trace_rays", rays_source, "-DCLRT_RAYS=1 -DCLRT_ALL_HITS=1", ARGUMENTS,
                  .dimensions = 1},
    [RAYS_CERTAIN] = {"certify_rays", certify_rays_source, NULL, ARGUMENTS, .dimensions = 1}};

// Makes the arrays that do not exist. An earlier call may have failed after it made some of them.
static bool make_arrays(RayCaster *caster, const Device *device, Error *error)
{
    static const size_t sizes[] = {CAST_RAYS / RAY_BLOCK * sizeof(RayBlock),
                                   HITS_MAX * sizeof(HitData), CAST_RAYS * sizeof(uint32_t)};
    SharedArray *const arrays[] = {&caster->blocks, &caster->hits, &caster->counts};
    bool ok = true;
    for (int i = 0; ok && i < 3; i++)
        ok = arrays[i]->buffer != NULL || shared_array_make(arrays[i], device, sizes[i], error);
    return ok;
}

bool ray_caster_open(RayCaster *caster, Session *session, RayQuery query, bool has_spheres,
                     Error *error)
{
    const KernelChoice exact = session_exact_choice();
    const RendererUse use = {.entry = &entries[query],
                             .choice = query == RAYS_CERTAIN ? &exact : NULL,
                             .is_general = true};
    SceneTraits traits = traits_general((SceneTraits){0});
    traits.spheres = has_spheres;
    if (query == RAYS_CERTAIN && !certifier_check_device(&session->device, error))
        return false;
    if (!make_arrays(caster, &session->device, error))
        return false;
    caster->kernels[query] = session_kernel(session, &use, &traits, error);
    return caster->kernels[query] != NULL;
}

void ray_caster_close(RayCaster *caster)
{
    ray_caster_free_scenes(caster);
    shared_array_free(&caster->blocks);
    shared_array_free(&caster->hits);
    shared_array_free(&caster->counts);
    *caster = (RayCaster){0};
}

static void free_scene(RayScene *scene)
{
    scene_form_free(&scene->form);
    free(scene->places);
    *scene = (RayScene){0};
}

void ray_caster_free_scenes(RayCaster *caster)
{
    for (int layout = 0; layout < NODE_LAYOUTS; layout++)
        free_scene(&caster->scenes[layout]);
}

static bool compile(RayScene *scene, const Session *session, NodeLayout layout, Error *error)
{
    scene->frame = normalization_of_primitives(session->scene.scene);
    const FlatSource source = {.scene = session->scene.scene,
                               .normalization = &scene->frame,
                               .layout = layout,
                               .is_two_sided = !scene->one_sided,
                               .has_tree = session->settings.wanted.tree != CLRT_TREE_NONE &&
                                           session_scene_wants_tree(session, layout)};
    const bool ok = session_scene_compile(session, &source, &scene->form, error);
    bvh_free(&scene->form.stages.bvh); // frees memory early
    return ok;
}

// Stores each triangle's mesh, and the triangle's number in this mesh before triangles were
// dropped.
static void name_triangles(TrianglePlace *places, const Scene *scene)
{
    for (uint32_t mesh = 0; mesh < scene->objects.count; mesh++) {
        const Mesh *named = &scene->objects.data[mesh].mesh;
        for (size_t i = 0; i < named->triangle_count; i++)
            *places++ = (TrianglePlace){NOTHING, mesh, (uint32_t)mesh_original_number(named, i)};
    }
}

static bool find_places(RayScene *scene, const Scene *source, Error *error)
{
    const FlatScene *flat = &scene->form.flat;
    scene->places = memory_raw(flat->triangle_count, sizeof *scene->places, error);
    if (scene->places == NULL)
        return false;
    name_triangles(scene->places, source);
    const bool is_pair = flat->layout == NODES_PAIR;
    const uint32_t slots = is_pair ? flat->triangle_count : flat->block_count * WIDE;
    for (uint32_t i = 0; i < slots; i++) {
        const uint32_t id = is_pair ? flat->triangles[i].id : flat->blocks[i / WIDE].id[i % WIDE];
        if (id != NOTHING)
            scene->places[(id & ~TRIANGLE_MARKS) - flat->sphere_count].index = i;
    }
    return true;
}

const RayScene *ray_caster_scene(RayCaster *caster, Session *session, RayQuery query,
                                 bool one_sided, Error *error)
{
    const Scene *source = session->scene.scene;
    if (!ray_caster_open(caster, session, query, source->spheres.count > 0, error))
        return NULL;
    const NodeLayout layout = caster->kernels[query]->choice.nodes;
    RayScene *scene = &caster->scenes[layout];
    if (scene->form.buffers.device != NULL && scene->one_sided == one_sided)
        return scene;
    free_scene(scene);
    scene->one_sided = one_sided;
    if (compile(scene, session, layout, error) && find_places(scene, source, error) &&
        scene_buffers_make(&scene->form.buffers, &session->device, &scene->form.flat, error))
        return scene;
    free_scene(scene);
    return NULL;
}

static bool launch(const RayCaster *caster, const RayCast *cast, Error *error)
{
    const Kernel *kernel = caster->kernels[cast->query];
    const size_t rays = kernel->choice.nodes == NODES_WIDE ? BLOCK_SIDE * BLOCK_SIDE : 1;
    const KernelRun run = {.queue = kernel->device->queue,
                           .frame = &cast->scene->frame,
                           .scene = cast->scene->arrays,
                           .arguments = {&caster->blocks.buffer, &cast->count, &cast->kinds,
                                         &cast->room, &caster->hits.buffer, &caster->counts.buffer},
                           .items = {(cast->count + rays - 1) / rays, 1}};
    return kernel_run(kernel, &run, error);
}

// Only the first call of shared_array_receive waits for the device.
bool ray_caster_cast(RayCaster *caster, const RayCast *cast, Error *error)
{
    const size_t blocks = (cast->count + RAY_BLOCK - 1) / RAY_BLOCK * sizeof(RayBlock);
    const size_t hits =
        cast->query == RAYS_CERTAIN ? 0 : (size_t)cast->count * cast->room * sizeof(HitData);
    const size_t counts = cast->query == RAYS_NEAREST ? 0 : cast->count * sizeof(uint32_t);
    bool ok = shared_array_send(&caster->blocks, blocks, error) &&
              shared_array_send(&caster->hits, 0, error) &&
              shared_array_send(&caster->counts, 0, error) && launch(caster, cast, error);
    ok = shared_array_receive(&caster->hits, ok ? hits : 0, error) && ok;
    ok = shared_array_receive(&caster->counts, ok ? counts : 0, error) && ok;
    ok = shared_array_receive(&caster->blocks, 0, error) && ok;
    if (!ok)
        clFinish(caster->kernels[cast->query]->device->queue); // the device may still read rays
    return ok;
}
