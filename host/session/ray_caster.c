// SPDX-License-Identifier: MIT
// All launches of a kernel use work-groups of one size, because PoCL compiles a kernel again for
// each size.
#include "session/ray_caster.h"

#include "device/buffer.h"
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

// Makes the buffer unless it exists. An earlier call may have failed after it made some of the
// buffers.
static bool make_buffer(cl_mem *buffer, const Device *device, size_t size, Error *error)
{
    return *buffer != NULL || device_buffer(device, size, buffer, error);
}

static bool make_buffers(RayCaster *caster, const Device *device, Error *error)
{
    return make_buffer(&caster->rays, device, CAST_RAYS * sizeof(RayData), error) &&
           make_buffer(&caster->hits, device, HITS_MAX * sizeof(HitData), error) &&
           make_buffer(&caster->counts, device, CAST_RAYS * sizeof(uint32_t), error);
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
    if (!make_buffers(caster, &session->device, error))
        return false;
    caster->kernels[query] = session_kernel(session, &use, &traits, error);
    return caster->kernels[query] != NULL;
}

void ray_caster_close(RayCaster *caster)
{
    ray_caster_free_scenes(caster);
    device_release(&caster->rays);
    device_release(&caster->hits);
    device_release(&caster->counts);
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
    const bool has_tree =
        session->settings.wanted.tree != CLRT_TREE_NONE && session_wants_tree(session, layout);
    scene->frame = normalization_of_primitives(session->scene.scene);
    const FlatSource source = {.scene = session->scene.scene,
                               .normalization = &scene->frame,
                               .layout = layout,
                               .is_two_sided = !scene->one_sided,
                               .has_tree = has_tree};
    if (!session_compile(session, &source, &scene->form, error))
        return false;
    bvh_free(&scene->form.stages.bvh); // frees memory early
    return true;
}

// Stores each triangle's mesh, and its number there before triangles were dropped.
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
    TrianglePlace *places = memory_raw(flat->triangle_count, sizeof *places, error);
    scene->places = places;
    if (places == NULL)
        return false;
    name_triangles(places, source);
    for (uint32_t i = 0; flat->layout == NODES_PAIR && i < flat->triangle_count; i++)
        places[flat->triangles[i].id - flat->sphere_count].index = i;
    for (uint32_t i = 0; i < flat->block_count * WIDE; i++) {
        const uint32_t word = flat->blocks[i / WIDE].id[i % WIDE];
        if (word != NOTHING)
            places[(word & ~TRIANGLE_MARKS) - flat->sphere_count].index = i;
    }
    return true;
}

const RayScene *ray_caster_scene(RayCaster *caster, Session *session, RayQuery query,
                                 bool one_sided, Error *error)
{
    if (!ray_caster_open(caster, session, query, session->scene.scene->spheres.count > 0, error))
        return NULL;
    RayScene *scene = &caster->scenes[caster->kernels[query]->choice.nodes];
    if (scene->is_loaded && scene->one_sided == one_sided)
        return scene;
    free_scene(scene);
    scene->one_sided = one_sided;
    scene->is_loaded =
        compile(scene, session, caster->kernels[query]->choice.nodes, error) &&
        find_places(scene, session->scene.scene, error) &&
        scene_buffers_make(&scene->form.buffers, &session->device, &scene->form.flat, error);
    if (scene->is_loaded)
        return scene;
    free_scene(scene);
    return NULL;
}

static bool launch(const RayCaster *caster, const RayCast *cast, Error *error)
{
    const Kernel *kernel = caster->kernels[cast->query];
    const bool has_blocks = kernel->choice.nodes == NODES_WIDE;
    const size_t item_rays = has_blocks ? BLOCK_SIDE * BLOCK_SIDE : 1;
    const cl_uint count = (cl_uint)cast->count;
    const cl_uint kinds = (cast->on_surfaces ? RAY_ON_SURFACE : 0) | (cast->any ? RAY_ANY_HIT : 0);
    const KernelRun run = {
        .queue = kernel->device->queue,
        .frame = &cast->scene->frame,
        .scene = cast->scene->arrays,
        .arguments = {&caster->rays, &count, &kinds, &cast->room, &caster->hits, &caster->counts},
        .items = {(count + item_rays - 1) / item_rays, 1}};
    return kernel_run(kernel, &run, error);
}

// The write and the launch return at once, and the reads wait for the device.
bool ray_caster_cast(const RayCaster *caster, const RayCast *cast, Error *error)
{
    const Device *device = caster->kernels[cast->query]->device;
    const size_t hits = cast->count * cast->room * sizeof *cast->hits;
    const bool ok =
        cl_succeeded(clEnqueueWriteBuffer(device->queue, caster->rays, CL_FALSE, 0,
                                          cast->count * sizeof *cast->rays, cast->rays, 0, NULL,
                                          NULL),
                     "write rays", error) &&
        launch(caster, cast, error) &&
        (cast->query == RAYS_CERTAIN || hits == 0 ||
         device_read(device, caster->hits, cast->hits, hits, error)) &&
        (cast->query == RAYS_NEAREST || device_read(device, caster->counts, cast->counts,
                                                    cast->count * sizeof *cast->counts, error));
    if (!ok)
        clFinish(device->queue); // the device may still read rays
    return ok;
}
