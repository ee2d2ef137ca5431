// SPDX-License-Identifier: MIT
// PoCL compiles a kernel again for each local size. This must happen under the lock of the kernel
// cache. The first launch therefore has no rays and runs under the lock, and all later launches
// have the same size.
#include "check/ray_caster.h"

#include "device/upload.h"

#define LAUNCH_RAYS 65536

// The smallest vector width of wide kernels; the host may not know the actual width.
#define FEWEST_LANES 4

// kernels/rays.cl, embedded at build time.
extern const char rays_source[];

void ray_caster_unload(RayCaster *caster)
{
    cl_mem *buffers[] = {&caster->spheres, &caster->nodes_array, &caster->faces};
    for (int i = 0; i < 3; i++) {
        if (*buffers[i] != NULL)
            clReleaseMemObject(*buffers[i]);
        *buffers[i] = NULL;
    }
}

bool ray_caster_load(RayCaster *caster, const FlatScene *flat, Error *error)
{
    const bool is_wide = flat->layout == NODES_WIDE;
    ray_caster_unload(caster);
    caster->frame = (FrameData){.sphere_count = flat->sphere_count,
                                .triangle_count = flat->triangle_count,
                                .uses_bvh = flat->node_count > 0};
    const Device *device = caster->device;
    const size_t nodes = flat->node_count;
    if (!upload_array(device, flat->spheres, flat->sphere_count * sizeof *flat->spheres,
                      &caster->spheres, error))
        return false;
    if (is_wide)
        return upload_array(device, flat->wides, nodes * sizeof *flat->wides, &caster->nodes_array,
                            error) &&
               upload_array(device, flat->blocks, flat->block_count * sizeof *flat->blocks,
                            &caster->faces, error);
    return upload_array(device, flat->pairs, nodes * sizeof *flat->pairs, &caster->nodes_array,
                        error) &&
           upload_array(device, flat->triangles, flat->triangle_count * sizeof *flat->triangles,
                        &caster->faces, error);
}

static bool launch(const RayCaster *caster, cl_uint count, Error *error)
{
    const bool is_wide = caster->nodes == NODES_WIDE;
    const size_t grid = is_wide ? LAUNCH_RAYS / FEWEST_LANES : LAUNCH_RAYS;
    const size_t group = is_wide ? 4 : 64;
    cl_kernel kernel = caster->kernel;
    cl_int status = clSetKernelArg(kernel, 0, sizeof caster->frame, &caster->frame);
    status |= clSetKernelArg(kernel, 1, sizeof(cl_mem), &caster->spheres);
    status |= clSetKernelArg(kernel, 2, sizeof(cl_mem), &caster->nodes_array);
    status |= clSetKernelArg(kernel, 3, sizeof(cl_mem), &caster->faces);
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
    cl_int status;
    cl_context context = caster->device->context;
    caster->rays =
        clCreateBuffer(context, CL_MEM_READ_ONLY, LAUNCH_RAYS * sizeof(AimRay), NULL, &status);
    if (!cl_succeeded(status, "allocate room for rays", error))
        return false;
    caster->distances =
        clCreateBuffer(context, CL_MEM_WRITE_ONLY, LAUNCH_RAYS * sizeof(float), NULL, &status);
    return cl_succeeded(status, "allocate room for distances", error);
}

static bool make_kernel(RayCaster *caster, Error *error)
{
    cl_int status;
    caster->kernel = clCreateKernel(caster->program.handle, "trace_rays", &status);
    return cl_succeeded(status, "create the kernel trace_rays", error) &&
           launch(caster, 0, error) &&
           cl_succeeded(clFinish(caster->device->queue), "finish the first run", error);
}

static bool build(RayCaster *caster, const RendererSetup *setup, Error *error)
{
    char key[PROGRAM_KEY_SIZE];
    CacheBuild build;
    const SceneTraits traits = traits_general(false);
    ProgramSource source = setup->source;
    source.appended = rays_source;
    program_key(caster->device, &source, &traits, key);
    cache_build_begin(&build, setup->cache, key);
    const bool ok = program_build(&caster->program, caster->device, &source, &traits, error) &&
                    make_kernel(caster, error);
    cache_build_end(&build, ok);
    return ok;
}

bool ray_caster_open(RayCaster *caster, const RendererSetup *setup, Error *error)
{
    const NodeLayout nodes = setup->source.choice.nodes;
    const FlatScene nothing = {.layout = nodes};
    *caster = (RayCaster){.device = setup->device, .nodes = nodes};
    const bool ok = make_room(caster, error) && ray_caster_load(caster, &nothing, error) &&
                    build(caster, setup, error);
    if (!ok)
        ray_caster_close(caster);
    return ok;
}

void ray_caster_close(RayCaster *caster)
{
    ray_caster_unload(caster);
    if (caster->rays != NULL)
        clReleaseMemObject(caster->rays);
    if (caster->distances != NULL)
        clReleaseMemObject(caster->distances);
    if (caster->kernel != NULL)
        clReleaseKernel(caster->kernel);
    program_free(&caster->program);
    *caster = (RayCaster){0};
}

static bool cast_launch(const RayCaster *caster, const AimRay *rays, size_t count, float *distances,
                        Error *error)
{
    cl_command_queue queue = caster->device->queue;
    cl_int status = clEnqueueWriteBuffer(queue, caster->rays, CL_TRUE, 0, count * sizeof *rays,
                                         rays, 0, NULL, NULL);
    if (!cl_succeeded(status, "write rays", error) || !launch(caster, (cl_uint)count, error))
        return false;
    status = clEnqueueReadBuffer(queue, caster->distances, CL_TRUE, 0, count * sizeof *distances,
                                 distances, 0, NULL, NULL);
    return cl_succeeded(status, "read distances", error);
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
