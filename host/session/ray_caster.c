// SPDX-License-Identifier: MIT
// Long lists of rays are split into launches, each of which fits the device buffers. All launches
// of a kernel use work-groups of one size, because PoCL compiles a kernel again for each size.
#include "session/ray_caster.h"

#include "device/buffer.h"

#define LAUNCH_RAYS 65536

// The smallest vector width of wide kernels; the host may not know the actual width.
#define FEWEST_LANES 4

// The kernels of rays take three of the arrays that flat_arrays lists: spheres, nodes and
// triangles.
#define FIRST_ARRAY 2
#define ARRAYS      3

// The rays of a launch that finds crossings. Each work-item traces one.
#define LAUNCH_CROSSED 16384

// kernels/rays.cl and kernels/crossings.cl, embedded at build time.
extern const char rays_source[], crossings_source[];

// Sets the first arguments of both kernels: the scene and the rays.
static cl_int set_rays(cl_kernel kernel, const SceneBuffers *scene, cl_mem rays, cl_uint count)
{
    cl_int status = clSetKernelArg(kernel, 0, sizeof scene->frame, &scene->frame);
    for (cl_uint i = 0; i < ARRAYS; i++)
        status |= clSetKernelArg(kernel, i + 1, sizeof(cl_mem), &scene->arrays[FIRST_ARRAY + i]);
    status |= clSetKernelArg(kernel, 4, sizeof(cl_mem), &rays);
    return status | clSetKernelArg(kernel, 5, sizeof count, &count);
}

static bool run(const Kernel *kernel, cl_int status, size_t grid, size_t group, Error *error)
{
    if (!cl_succeeded(status, "set the arguments of a kernel for rays", error))
        return false;
    status = clEnqueueNDRangeKernel(kernel->device->queue, kernel->handle, 1, NULL, &grid, &group,
                                    0, NULL, NULL);
    return cl_succeeded(status, "run a kernel for rays", error);
}

static bool launch(const RayCaster *caster, const SceneBuffers *scene, cl_uint count, cl_uint kind,
                   Error *error)
{
    cl_kernel kernel = caster->kernel->handle;
    const bool is_wide = caster->kernel->choice.nodes == NODES_WIDE;
    cl_int status = set_rays(kernel, scene, caster->rays, count);
    status |= clSetKernelArg(kernel, 6, sizeof kind, &kind);
    status |= clSetKernelArg(kernel, 7, sizeof(cl_mem), &caster->hits);
    const size_t group = is_wide ? 4 : 64, items = is_wide ? count / FEWEST_LANES + 1 : count + 1;
    return run(caster->kernel, status, (items + group - 1) / group * group, group, error);
}

static bool cast_nothing(Renderer *renderer, Error *error)
{
    const cl_mem nothing = renderer->scene->arrays[0];
    const RayCaster caster = {renderer->kernel, nothing, nothing};
    return launch(&caster, renderer->scene, 0, RAYS_FREE, error) &&
           cl_succeeded(clFinish(renderer->kernel->device->queue), "finish the first run", error);
}

static bool first_run(const Kernel *kernel, Error *error)
{
    return renderer_run_first(kernel, cast_nothing, error);
}

static const KernelEntry rays_entry = {"trace_rays", rays_source, "-DCLRT_RAYS=1", first_run};

bool ray_caster_open(RayCaster *caster, Session *session, Error *error)
{
    const RendererUse use = {.entry = &rays_entry, .is_general = true};
    const SceneTraits traits = traits_general(false);
    *caster = (RayCaster){.kernel = session_kernel(session, &use, &traits, error)};
    if (caster->kernel != NULL &&
        device_buffer(&session->device, LAUNCH_RAYS * sizeof(RayData), &caster->rays, error) &&
        device_buffer(&session->device, LAUNCH_RAYS * sizeof(HitData), &caster->hits, error))
        return true;
    ray_caster_close(caster);
    return false;
}

void ray_caster_close(RayCaster *caster)
{
    device_release(&caster->rays);
    device_release(&caster->hits);
    *caster = (RayCaster){0};
}

// Does not wait. The rays must not change until results are read or abandon_cast() returns.
static bool write_rays(const Device *device, cl_mem buffer, const RayData *rays, size_t count,
                       Error *error)
{
    return cl_succeeded(clEnqueueWriteBuffer(device->queue, buffer, CL_FALSE, 0,
                                             count * sizeof *rays, rays, 0, NULL, NULL),
                        "write rays", error);
}

// Ends a failed cast: waits until the device no longer reads rays. Returns false.
static bool abandon_cast(const Device *device)
{
    clFinish(device->queue);
    return false;
}

static size_t smaller(size_t a, size_t b)
{
    return a < b ? a : b;
}

bool ray_caster_cast(const RayCaster *caster, const RayCast *cast, HitData *hits, Error *error)
{
    const Device *device = caster->kernel->device;
    for (size_t first = 0; first < cast->count; first += LAUNCH_RAYS) {
        const size_t count = smaller(cast->count - first, LAUNCH_RAYS);
        const cl_uint kind = cast->start | (cast->any ? RAY_ANY_HIT : 0);
        if (!write_rays(device, caster->rays, cast->rays + first, count, error) ||
            !launch(caster, cast->scene, (cl_uint)count, kind, error) ||
            !device_read(device, caster->hits, hits + first, count * sizeof *hits, error))
            return abandon_cast(device);
    }
    return true;
}

static bool find_launch(const CrossingFinder *finder, const SceneBuffers *scene, cl_uint count,
                        cl_uint room, Error *error)
{
    cl_kernel kernel = finder->kernel->handle;
    cl_int status = set_rays(kernel, scene, finder->rays, count);
    status |= clSetKernelArg(kernel, 6, sizeof room, &room);
    status |= clSetKernelArg(kernel, 7, sizeof(cl_mem), &finder->hits);
    status |= clSetKernelArg(kernel, 8, sizeof(cl_mem), &finder->counts);
    return run(finder->kernel, status, LAUNCH_CROSSED, 64, error);
}

static bool find_nothing(Renderer *renderer, Error *error)
{
    const cl_mem nothing = renderer->scene->arrays[0];
    const CrossingFinder finder = {renderer->kernel, nothing, nothing, nothing};
    return find_launch(&finder, renderer->scene, 0, 0, error) &&
           cl_succeeded(clFinish(renderer->kernel->device->queue), "finish the first run", error);
}

static bool first_find(const Kernel *kernel, Error *error)
{
    return renderer_run_first(kernel, find_nothing, error);
}

static const KernelEntry crossings_entry = {"find_crossings", crossings_source, NULL, first_find};

bool crossing_finder_open(CrossingFinder *finder, Session *session, Error *error)
{
    const RendererUse use = {.entry = &crossings_entry, .is_general = true};
    const SceneTraits traits = traits_general(false);
    const Device *device = &session->device;
    *finder = (CrossingFinder){.kernel = session_kernel(session, &use, &traits, error)};
    if (finder->kernel != NULL &&
        device_buffer(device, LAUNCH_CROSSED * sizeof(RayData), &finder->rays, error) &&
        device_buffer(device, CROSSINGS_MAX * sizeof(HitData), &finder->hits, error) &&
        device_buffer(device, LAUNCH_CROSSED * sizeof(uint32_t), &finder->counts, error))
        return true;
    crossing_finder_close(finder);
    return false;
}

void crossing_finder_close(CrossingFinder *finder)
{
    device_release(&finder->rays);
    device_release(&finder->hits);
    device_release(&finder->counts);
    *finder = (CrossingFinder){0};
}

bool crossing_finder_find(const CrossingFinder *finder, const RayCast *cast, CrossingList *found,
                          Error *error)
{
    const Device *device = finder->kernel->device;
    const size_t room = found->room;
    const size_t most = smaller(LAUNCH_CROSSED, room > 0 ? CROSSINGS_MAX / room : SIZE_MAX);
    for (size_t first = 0; first < cast->count; first += most) {
        const size_t count = smaller(cast->count - first, most);
        if (!write_rays(device, finder->rays, cast->rays + first, count, error) ||
            !find_launch(finder, cast->scene, (cl_uint)count, found->room, error) ||
            !device_read(device, finder->counts, found->counts + first,
                         count * sizeof *found->counts, error) ||
            (room > 0 && !device_read(device, finder->hits, found->hits + first * room,
                                      count * room * sizeof *found->hits, error)))
            return abandon_cast(device);
    }
    return true;
}
