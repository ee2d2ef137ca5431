// SPDX-License-Identifier: MIT
// All launches of a kernel use work-groups of one size, because PoCL compiles a kernel again for
// each size.
#include "session/ray_caster.h"

#include "device/buffer.h"
#include "render/certifier.h"

// Files of kernels, embedded at build time.
extern const char rays_source[], crossings_source[], certify_rays_source[];

static const KernelEntry entries[RAY_QUERIES] = {
    [RAYS_NEAREST] = {"trace_rays", rays_source, "-DCLRT_RAYS=1", "bnnb", .dimensions = 1},
    [RAYS_CROSSED] = {"find_crossings", crossings_source, NULL, "bnnbb", .dimensions = 1,
                      .group = 64},
    [RAYS_CERTAIN] = {"certify_rays", certify_rays_source, NULL, "bnnb", .dimensions = 1}};

static bool finds_all(const RayCaster *caster)
{
    return caster->kernel->entry == &entries[RAYS_CROSSED];
}

static bool make_buffers(RayCaster *caster, const Device *device, Error *error)
{
    const size_t hits = finds_all(caster) ? CROSSINGS_MAX : CAST_RAYS;
    return device_buffer(device, CAST_RAYS * sizeof(RayData), &caster->rays, error) &&
           device_buffer(device, hits * sizeof(HitData), &caster->hits, error) &&
           (!finds_all(caster) ||
            device_buffer(device, CAST_RAYS * sizeof(uint32_t), &caster->counts, error));
}

bool ray_caster_open(RayCaster *caster, Session *session, RayQuery query, Error *error)
{
    const KernelChoice exact = session_exact_choice();
    const RendererUse use = {.entry = &entries[query],
                             .choice = query == RAYS_CERTAIN ? &exact : NULL,
                             .is_general = true};
    const SceneTraits traits = traits_general((SceneTraits){0});
    *caster = (RayCaster){0};
    if (query == RAYS_CERTAIN && !certifier_check_device(&session->device, error))
        return false;
    caster->kernel = session_kernel(session, &use, &traits, error);
    if (caster->kernel != NULL && make_buffers(caster, &session->device, error))
        return true;
    ray_caster_close(caster);
    return false;
}

void ray_caster_close(RayCaster *caster)
{
    device_release(&caster->rays);
    device_release(&caster->hits);
    device_release(&caster->counts);
    *caster = (RayCaster){0};
}

static bool launch(const RayCaster *caster, const RayCast *cast, Error *error)
{
    const Kernel *kernel = caster->kernel;
    const bool all = finds_all(caster), has_blocks = kernel->choice.nodes == NODES_WIDE && !all;
    const size_t item_rays = has_blocks ? BLOCK_SIDE * BLOCK_SIDE : 1;
    const cl_uint count = (cl_uint)cast->count, kind = cast->start | (cast->any ? RAY_ANY_HIT : 0);
    const KernelRun run = {.queue = kernel->device->queue,
                           .frame = &cast->scene->frame,
                           .scene = cast->scene->arrays,
                           .arguments = {&caster->rays, &count, all ? &cast->room : &kind,
                                         &caster->hits, &caster->counts},
                           .items = {(count + item_rays - 1) / item_rays, 1}};
    return kernel_run(kernel, &run, error);
}

// The write and the launch return at once, and the reads wait for the device.
bool ray_caster_cast(const RayCaster *caster, const RayCast *cast, HitData *hits, uint32_t *counts,
                     Error *error)
{
    const Device *device = caster->kernel->device;
    const bool all = finds_all(caster);
    const size_t rays = cast->count * sizeof *cast->rays;
    const size_t found = cast->count * (all ? cast->room : 1) * sizeof *hits;
    const bool ok =
        cl_succeeded(clEnqueueWriteBuffer(device->queue, caster->rays, CL_FALSE, 0, rays,
                                          cast->rays, 0, NULL, NULL),
                     "write rays", error) &&
        launch(caster, cast, error) &&
        (found == 0 || device_read(device, caster->hits, hits, found, error)) &&
        (!all || device_read(device, caster->counts, counts, cast->count * sizeof *counts, error));
    if (!ok)
        clFinish(device->queue); // the device may still read rays
    return ok;
}
