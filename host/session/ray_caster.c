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

// Makes the array unless it exists. An earlier call may have failed after it made a part.
static bool make_array(CastArray *array, const Device *device, size_t size, Error *error)
{
    if (array->data == NULL)
        array->data = memory_raw(size, 1, error);
    return array->buffer != NULL ||
           (array->data != NULL && buffer_make(device, array->data, size, &array->buffer, error));
}

static bool make_arrays(RayCaster *caster, const Device *device, Error *error)
{
    const size_t blocks = CAST_RAYS / RAY_BLOCK * sizeof(RayBlock);
    return make_array(&caster->blocks, device, blocks, error) &&
           make_array(&caster->hits, device, HITS_MAX * sizeof(HitData), error) &&
           make_array(&caster->counts, device, CAST_RAYS * sizeof(uint32_t), error);
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

static void free_array(CastArray *array)
{
    buffer_release(&array->buffer);
    free(array->data);
}

void ray_caster_close(RayCaster *caster)
{
    ray_caster_free_scenes(caster);
    free_array(&caster->blocks);
    free_array(&caster->hits);
    free_array(&caster->counts);
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

// The write and the launch return at once, and the reads wait for the device.
bool ray_caster_cast(const RayCaster *caster, const RayCast *cast, Error *error)
{
    const Device *device = caster->kernels[cast->query]->device;
    const CastArray *blocks = &caster->blocks, *hits = &caster->hits, *counts = &caster->counts;
    const size_t size = (cast->count + RAY_BLOCK - 1) / RAY_BLOCK * sizeof(RayBlock);
    const size_t found = (size_t)cast->count * cast->room * sizeof(HitData);
    const bool ok =
        cl_succeeded(clEnqueueWriteBuffer(device->queue, blocks->buffer, CL_FALSE, 0, size,
                                          blocks->data, 0, NULL, NULL),
                     "write rays", error) &&
        launch(caster, cast, error) &&
        (cast->query == RAYS_CERTAIN || found == 0 ||
         buffer_read(device, hits->buffer, hits->data, found, error)) &&
        (cast->query == RAYS_NEAREST ||
         buffer_read(device, counts->buffer, counts->data, cast->count * sizeof(uint32_t), error));
    if (!ok)
        clFinish(device->queue); // the device may still use the arrays
    return ok;
}
