// SPDX-License-Identifier: MIT
// Long lists of rays are split into launches, each of which fits the device buffers. All launches
// of a kernel use work-groups of one size, because PoCL compiles a kernel again for each size.
#include "session/ray_caster.h"

#include "device/buffer.h"
#include "render/certifier.h"

// The usual number of rays in a launch. Large GPUs need more.
#define LAUNCH_RAYS 65536

// The smallest vector width of wide kernels; the host may not know the actual width.
#define FEWEST_LANES 4

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

// Runs the kernel for the first `count` rays in the buffer.
static bool launch(const RayCaster *caster, const RayCast *cast, size_t count, Error *error)
{
    const Kernel *kernel = caster->kernel;
    const bool all = finds_all(caster), has_lanes = kernel->choice.nodes == NODES_WIDE && !all;
    const cl_uint number = (cl_uint)count, kind = cast->start | (cast->any ? RAY_ANY_HIT : 0);
    const KernelRun run = {.queue = kernel->device->queue,
                           .frame = &cast->scene->frame,
                           .scene = cast->scene->arrays,
                           .arguments = {&caster->rays, &number, all ? &cast->room : &kind,
                                         &caster->hits, &caster->counts},
                           .items = {(has_lanes ? count / FEWEST_LANES : count) + 1, 1}};
    return kernel_run(kernel, &run, error);
}

static size_t launch_rays(const RayCaster *caster)
{
    const uint32_t items = caster->kernel->launch.items;
    return items > LAUNCH_RAYS ? items : LAUNCH_RAYS;
}

static bool make_buffers(RayCaster *caster, const Device *device, Error *error)
{
    const size_t rays = launch_rays(caster);
    const size_t hits = finds_all(caster) ? CROSSINGS_MAX : rays;
    return device_buffer(device, rays * sizeof(RayData), &caster->rays, error) &&
           device_buffer(device, hits * sizeof(HitData), &caster->hits, error) &&
           (!finds_all(caster) ||
            device_buffer(device, rays * sizeof(uint32_t), &caster->counts, error));
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

static size_t smaller(size_t a, size_t b)
{
    return a < b ? a : b;
}

// Sends the rays, runs the kernel and reads the results, for at most launch_rays rays. Only the
// reads wait for the device.
static bool cast_launch(const RayCaster *caster, const RayCast *cast, HitData *hits,
                        uint32_t *counts, Error *error)
{
    const Device *device = caster->kernel->device;
    const bool all = finds_all(caster);
    const size_t found = cast->count * (all ? cast->room : 1);
    return cl_succeeded(clEnqueueWriteBuffer(device->queue, caster->rays, CL_FALSE, 0,
                                             cast->count * sizeof *cast->rays, cast->rays, 0, NULL,
                                             NULL),
                        "write rays", error) &&
           launch(caster, cast, cast->count, error) &&
           (found == 0 || device_read(device, caster->hits, hits, found * sizeof *hits, error)) &&
           (!all ||
            device_read(device, caster->counts, counts, cast->count * sizeof *counts, error));
}

bool ray_caster_cast(const RayCaster *caster, const RayCast *cast, HitData *hits, uint32_t *counts,
                     Error *error)
{
    const size_t room = finds_all(caster) ? cast->room : 1;
    const size_t most = smaller(launch_rays(caster), CROSSINGS_MAX / (room > 0 ? room : 1));
    RayCast part = *cast;
    for (size_t first = 0; first < cast->count; first += most) {
        part.rays = cast->rays + first;
        part.count = smaller(cast->count - first, most);
        if (cast_launch(caster, &part, hits + first * room, counts != NULL ? counts + first : NULL,
                        error))
            continue;
        clFinish(caster->kernel->device->queue); // the device may still read rays
        return false;
    }
    return true;
}
