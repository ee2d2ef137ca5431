// SPDX-License-Identifier: MIT
// Implements clrt_trace, clrt_trace_all, clrt_contains and clrt_occluded. A batch of rays is traced
// part by part, so batches of any size require little memory.
//
// Programs list the rays of a picture row by row, but 64 rays of a square visit fewer nodes than 64
// rays of a row. The rays of a picture are therefore reordered into beams of 64 rays. The order
// changes no bit of the hits.
#include "base/processors.h"
#include "library/ray_results.h"

// A part has at least LEAST_RAYS rays, and about THREAD_RAYS for each thread. With fewer rays per
// thread, the threads of a part would mostly wait for each other. With more rays per thread, their
// data would not fit into a core's L2 cache.
#define THREAD_RAYS 8192
#define LEAST_RAYS  16384

// Rays in a beam, rows in a block, and the limits of the number of rays in a row.
#define BEAM_RAYS   64
#define BLOCK_ROWS  8
#define LEAST_WIDTH 16
#define MOST_WIDTH  8192

// Returns the vector from a ray's point at t = 1 to the next ray's point at t = 1.
static Vec3 step_after(const ClrtRays *rays, size_t index)
{
    const GivenRay a = given_ray(rays, index), b = given_ray(rays, index + 1);
    return vec3_sub(vec3_add(b.origin, b.direction), vec3_add(a.origin, a.direction));
}

// Returns the length of a row if the rays form a grid, otherwise 0. In a grid, the points at t = 1
// advance in one direction and jump back at the end of each row.
static size_t grid_width(const ClrtRays *rays)
{
    const size_t most = rays->count / 2 < MOST_WIDTH ? rays->count / 2 : MOST_WIDTH;
    if (most < LEAST_WIDTH)
        return 0;
    const Vec3 step = step_after(rays, 0);
    size_t width = 1;
    while (width < most && !(vec3_dot(step_after(rays, width - 1), step) < 0))
        width++;
    const bool is_grid =
        width >= LEAST_WIDTH && width < most && vec3_dot(step_after(rays, 2 * width - 1), step) < 0;
    return is_grid ? width : 0;
}

// Orders the rays of a part. In a grid with rows of `width` rays, consecutive entries form blocks
// of 64 rays, or less at the right edge. If the last rows are too few for blocks, they come last in
// ascending order. If `width` is 0, the order stays as given.
static void order_rays(RayBatch *batch, size_t width)
{
    const size_t count = batch->cast.count;
    size_t filled = 0, height = BLOCK_ROWS;
    batch->is_ordered = width > 0;
    if (!batch->is_ordered)
        return;
    while (height * width > count)
        height /= 2;
    const size_t side = height > 0 ? BEAM_RAYS / height : 0;
    for (size_t top = 0; height > 0 && (top + height) * width <= count; top += height)
        for (size_t left = 0; left < width; left += side)
            for (size_t y = top; y < top + height; y++)
                for (size_t x = left; x < left + side && x < width; x++)
                    batch->order[filled++] = (uint32_t)(y * width + x);
    for (; filled < count; filled++)
        batch->order[filled] = (uint32_t)filled;
}

// Casts the rays of the present part, and stores the results.
static bool cast(ClrtRenderer *renderer, RayQuery query, ClrtError *error)
{
    Error cause = {0};
    RayBatch *batch = renderer->batch;
    batch->scene = ray_caster_scene(&renderer->caster, &renderer->session, query,
                                    batch->rays.one_sided, &cause);
    if (batch->scene == NULL)
        return library_fail_for(error, CLRT_DEVICE, &cause);
    batch->cast.query = query;
    batch->cast.scene = &batch->scene->form.buffers;
    if (!ray_batch_convert(batch, error))
        return false;
    if (!ray_caster_cast(&renderer->caster, &batch->cast, &cause))
        return library_fail_for(error, CLRT_DEVICE, &cause);
    ray_results_store(batch);
    return true;
}

static bool cast_parts(ClrtRenderer *renderer, size_t most, ClrtError *error)
{
    RayBatch *batch = renderer->batch;
    const ClrtRays *rays = &batch->rays;
    const RayResults *results = &batch->results;
    const size_t width = grid_width(rays);
    const uint64_t parts = (rays->count + most - 1) / most;
    for (uint64_t done = 0; done < parts; done++) {
        batch->first = done * most;
        const size_t left = rays->count - batch->first;
        batch->cast.count = (cl_uint)(left < most ? left : most);
        order_rays(batch, width);
        if (!cast(renderer, results->query, error) ||
            (results->hits.certain != NULL && !cast(renderer, RAYS_CERTAIN, error)))
            return false;
        if (rays->progress != NULL && !rays->progress(rays->user, done + 1, parts) &&
            done + 1 < parts)
            return library_fail(error, CLRT_STOPPED,
                                "the rays were stopped after %llu of %llu parts",
                                (unsigned long long)(done + 1), (unsigned long long)parts);
    }
    return true;
}

static bool cast_batch(ClrtRenderer *renderer, ClrtError *error)
{
    RayBatch *batch = renderer->batch;
    const size_t count = batch->rays.count, room = batch->results.hits.room;
    const size_t most = HITS_MAX / (room > 0 ? room : 1);
    uint32_t threads = count > LEAST_RAYS ? renderer->session.settings.wanted.threads : 1;
    if (threads == 0)
        threads = processors_usable();
    size_t part = LEAST_RAYS;
    while (part < PART_RAYS && part < count && part < (size_t)threads * THREAD_RAYS)
        part *= 2;
    const bool is_nearest = batch->results.query == RAYS_NEAREST;
    const bool starts = is_nearest && batch->rays.starts != NULL;
    const bool any = is_nearest && batch->results.flags != NULL;
    batch->cast = (RayCast){.kinds = (starts ? RAY_ON_SURFACE : 0) | (any ? RAY_ANY_HIT : 0),
                            .room = (cl_uint)room};
    batch->caster = &renderer->caster;
    batch->pool = thread_pool_open(threads);
    const bool ok = cast_parts(renderer, most < part ? most : part, error);
    thread_pool_close(batch->pool);
    return ok;
}

static bool trace(ClrtRenderer *renderer, const ClrtScene *scene, const ClrtRays *rays,
                  const RayResults *results, ClrtError *error)
{
    Error cause = {0};
    if (!renderer_handle_begin(renderer, scene, error))
        return false;
    if (renderer->batch == NULL)
        renderer->batch = memory_raw(1, sizeof *renderer->batch, &cause);
    RayBatch *batch = renderer->batch;
    bool ok =
        (batch != NULL || library_fail_for(error, CLRT_DEVICE, &cause)) &&
        argument_struct(error, "the rays", rays, &batch->rays, sizeof batch->rays) &&
        (batch->rays.count == 0 || argument_given(error, "the origins", batch->rays.origins)) &&
        renderer_handle_take(renderer, scene, error);
    if (ok) {
        batch->results = *results;
        ok = cast_batch(renderer, error);
    }
    renderer_handle_end(renderer);
    return ok;
}

bool clrt_trace(ClrtRenderer *renderer, const ClrtScene *scene, const ClrtRays *rays,
                const ClrtHits *hits, ClrtError *error)
{
    RayResults results = {.query = RAYS_NEAREST};
    if (!argument_struct(error, "the hits", hits, &results.hits, sizeof results.hits))
        return false;
    results.hits.room = 1;
    results.hits.counts = NULL;
    return trace(renderer, scene, rays, &results, error);
}

bool clrt_trace_all(ClrtRenderer *renderer, const ClrtScene *scene, const ClrtRays *rays,
                    const ClrtHits *hits, ClrtError *error)
{
    RayResults results = {.query = RAYS_ALL};
    return argument_struct(error, "the hits", hits, &results.hits, sizeof results.hits) &&
           argument_number(error, "the room for hits", (double)results.hits.room, 0, HITS_MAX) &&
           (results.hits.certain == NULL ||
            library_fail(error, CLRT_ARGUMENT, "only clrt_trace finds which rays are certain")) &&
           trace(renderer, scene, rays, &results, error);
}

bool clrt_occluded(ClrtRenderer *renderer, const ClrtScene *scene, const ClrtRays *rays,
                   uint8_t *occluded, ClrtError *error)
{
    const RayResults results = {.query = RAYS_NEAREST, .hits.room = 1, .flags = occluded};
    return argument_given(error, "the array of results", occluded) &&
           trace(renderer, scene, rays, &results, error);
}

bool clrt_contains(ClrtRenderer *renderer, const ClrtScene *scene, const ClrtRays *rays,
                   uint8_t *inside, ClrtError *error)
{
    const RayResults results = {.query = RAYS_ALL, .flags = inside};
    return argument_given(error, "the array of results", inside) &&
           trace(renderer, scene, rays, &results, error);
}
