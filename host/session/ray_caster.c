// SPDX-License-Identifier: MIT
// All launches have the same size, because PoCL compiles a kernel again for each size.
#include "session/ray_caster.h"

#include "device/buffer.h"

#define LAUNCH_RAYS 65536

// The smallest vector width of wide kernels; the host may not know the actual width.
#define FEWEST_LANES 4

// Rays need three of the arrays that flat_arrays lists: spheres, nodes and triangles.
#define FIRST_ARRAY 2
#define ARRAYS      3

// kernels/rays.cl, embedded at build time.
extern const char rays_source[];

void ray_caster_unload(RayCaster *caster)
{
    scene_buffers_free(&caster->scene);
}

bool ray_caster_load(RayCaster *caster, const FlatScene *flat, Error *error)
{
    ray_caster_unload(caster);
    return scene_buffers_make(&caster->scene, caster->kernel->device, flat, error);
}

// A scene and the buffers of its rays.
typedef struct {
    const Kernel *kernel;
    const SceneBuffers *scene;
    cl_mem rays, distances;
} Launch;

static bool launch(const Launch *input, cl_uint count, Error *error)
{
    const bool is_wide = input->kernel->choice.nodes == NODES_WIDE;
    const size_t grid = is_wide ? LAUNCH_RAYS / FEWEST_LANES : LAUNCH_RAYS;
    const size_t group = is_wide ? 4 : 64;
    cl_kernel kernel = input->kernel->handle;
    cl_int status = clSetKernelArg(kernel, 0, sizeof input->scene->frame, &input->scene->frame);
    for (cl_uint i = 0; i < ARRAYS; i++)
        status |=
            clSetKernelArg(kernel, i + 1, sizeof(cl_mem), &input->scene->arrays[FIRST_ARRAY + i]);
    status |= clSetKernelArg(kernel, 4, sizeof(cl_mem), &input->rays);
    status |= clSetKernelArg(kernel, 5, sizeof count, &count);
    status |= clSetKernelArg(kernel, 6, sizeof(cl_mem), &input->distances);
    if (!cl_succeeded(status, "set the arguments of the kernel trace_rays", error))
        return false;
    status = clEnqueueNDRangeKernel(input->kernel->device->queue, kernel, 1, NULL, &grid, &group, 0,
                                    NULL, NULL);
    return cl_succeeded(status, "run the kernel trace_rays", error);
}

static bool cast_nothing(Renderer *renderer, Error *error)
{
    const cl_mem nothing = renderer->scene->arrays[0];
    const Launch input = {renderer->kernel, renderer->scene, nothing, nothing};
    return launch(&input, 0, error) &&
           cl_succeeded(clFinish(renderer->kernel->device->queue), "finish the first run", error);
}

static bool first_run(const Kernel *kernel, Error *error)
{
    return renderer_run_first(kernel, cast_nothing, error);
}

static const KernelEntry rays_entry = {"trace_rays", rays_source, NULL, first_run};

bool ray_caster_open(RayCaster *caster, Session *session, Error *error)
{
    const RendererUse use = {.entry = &rays_entry, .is_general = true};
    const SceneTraits traits = traits_general(false);
    *caster = (RayCaster){.kernel = session_kernel(session, &use, &traits, error)};
    if (caster->kernel != NULL &&
        device_buffer(&session->device, LAUNCH_RAYS * sizeof(CastRay), &caster->rays, error) &&
        device_buffer(&session->device, LAUNCH_RAYS * sizeof(float), &caster->distances, error))
        return true;
    ray_caster_close(caster);
    return false;
}

void ray_caster_close(RayCaster *caster)
{
    ray_caster_unload(caster);
    device_release(&caster->rays);
    device_release(&caster->distances);
    *caster = (RayCaster){0};
}

static bool cast_launch(const RayCaster *caster, const CastRay *rays, size_t count,
                        float *distances, Error *error)
{
    const Device *device = caster->kernel->device;
    const Launch input = {caster->kernel, &caster->scene, caster->rays, caster->distances};
    const cl_int status = clEnqueueWriteBuffer(device->queue, caster->rays, CL_TRUE, 0,
                                               count * sizeof *rays, rays, 0, NULL, NULL);
    return cl_succeeded(status, "write rays", error) && launch(&input, (cl_uint)count, error) &&
           device_read(device, caster->distances, distances, count * sizeof *distances, error);
}

bool ray_caster_cast(const RayCaster *caster, const CastRay *rays, size_t count, float *distances,
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
