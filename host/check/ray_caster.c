// SPDX-License-Identifier: MIT
// PoCL compiles a kernel again for each local size. This must happen under the lock of the kernel
// cache. The first launch therefore has no rays and runs under the lock, and all later launches
// have the same size.
#include "check/leaks.h"

#include "device/buffer.h"

#define LAUNCH_RAYS 65536

// The smallest vector width of wide kernels; the host may not know the actual width.
#define FEWEST_LANES 4

// kernels/rays.cl, embedded at build time.
extern const char rays_source[];

void ray_caster_unload(RayCaster *caster)
{
    for (int i = 0; i < CASTER_ARRAYS; i++)
        device_release(&caster->arrays[i]);
}

bool ray_caster_load(RayCaster *caster, const FlatScene *flat, Error *error)
{
    bool ok = true;
    FlatArray arrays[FLAT_ARRAYS];
    const FlatArray *first = &arrays[CASTER_FIRST];
    ray_caster_unload(caster);
    flat_arrays(flat, arrays);
    caster->frame = (FrameData){.sphere_count = flat->sphere_count,
                                .triangle_count = flat->triangle_count,
                                .uses_bvh = flat->node_count > 0};
    for (int i = 0; ok && i < CASTER_ARRAYS; i++)
        ok = upload_array(caster->device, &first[i], &caster->arrays[i], error);
    return ok;
}

static bool launch(const RayCaster *caster, cl_uint count, Error *error)
{
    const bool is_wide = caster->nodes == NODES_WIDE;
    const size_t grid = is_wide ? LAUNCH_RAYS / FEWEST_LANES : LAUNCH_RAYS;
    const size_t group = is_wide ? 4 : 64;
    cl_kernel kernel = caster->kernel;
    cl_int status = clSetKernelArg(kernel, 0, sizeof caster->frame, &caster->frame);
    for (cl_uint i = 0; i < CASTER_ARRAYS; i++)
        status |= clSetKernelArg(kernel, i + 1, sizeof(cl_mem), &caster->arrays[i]);
    status |= clSetKernelArg(kernel, 4, sizeof(cl_mem), &caster->rays);
    status |= clSetKernelArg(kernel, 5, sizeof count, &count);
    status |= clSetKernelArg(kernel, 6, sizeof(cl_mem), &caster->distances);
    if (!cl_succeeded(status, "set the arguments of the kernel trace_rays", error))
        return false;
    status = clEnqueueNDRangeKernel(caster->device->queue, kernel, 1, NULL, &grid, &group, 0, NULL,
                                    NULL);
    return cl_succeeded(status, "run the kernel trace_rays", error);
}

static bool make_room(RayCaster *caster, Error *error)
{
    return device_buffer(caster->device, LAUNCH_RAYS * sizeof(AimRay), &caster->rays, error) &&
           device_buffer(caster->device, LAUNCH_RAYS * sizeof(float), &caster->distances, error);
}

static bool make_kernel(void *context, Error *error)
{
    RayCaster *caster = context;
    cl_int status;
    caster->kernel = clCreateKernel(caster->program.handle, "trace_rays", &status);
    return cl_succeeded(status, "create the kernel trace_rays", error) &&
           launch(caster, 0, error) &&
           cl_succeeded(clFinish(caster->device->queue), "finish the first run", error);
}

bool ray_caster_open(RayCaster *caster, const RendererSetup *setup, Error *error)
{
    const NodeLayout nodes = setup->source.choice.nodes;
    const FlatScene nothing = {.layout = nodes};
    *caster = (RayCaster){.device = setup->device, .nodes = nodes};
    const SceneTraits traits = traits_general(false);
    const FirstRun first = {make_kernel, caster};
    RendererSetup with_rays = *setup;
    with_rays.source.appended = rays_source;
    const bool ok = make_room(caster, error) && ray_caster_load(caster, &nothing, error) &&
                    program_make(&caster->program, &with_rays, &traits, &first, error);
    if (!ok)
        ray_caster_close(caster);
    return ok;
}

void ray_caster_close(RayCaster *caster)
{
    ray_caster_unload(caster);
    device_release(&caster->rays);
    device_release(&caster->distances);
    device_release_kernel(&caster->kernel);
    program_free(&caster->program);
    *caster = (RayCaster){0};
}

static bool cast_launch(const RayCaster *caster, const AimRay *rays, size_t count, float *distances,
                        Error *error)
{
    const cl_int status = clEnqueueWriteBuffer(caster->device->queue, caster->rays, CL_TRUE, 0,
                                               count * sizeof *rays, rays, 0, NULL, NULL);
    return cl_succeeded(status, "write rays", error) && launch(caster, (cl_uint)count, error) &&
           device_read(caster->device, caster->distances, distances, count * sizeof *distances,
                       error);
}

bool ray_caster_cast(const RayCaster *caster, const AimRay *rays, size_t count, float *distances,
                     Error *error)
{
    for (size_t first = 0; first < count; first += LAUNCH_RAYS) {
        const size_t left = count - first;
        if (!cast_launch(caster, rays + first, left < LAUNCH_RAYS ? left : LAUNCH_RAYS,
                         distances + first, error))
            return false;
    }
    return true;
}
