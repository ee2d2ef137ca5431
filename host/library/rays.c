// SPDX-License-Identifier: MIT
// Implements clrt_trace, clrt_trace_all, clrt_contains and clrt_occluded. A batch of rays is traced
// part by part, so batches of any size require little memory.
#include "base/thread_pool.h"
#include "library/ray_order.h"

// A part has at least LEAST_RAYS rays, and about THREAD_RAYS for each thread. With fewer rays per
// thread, the threads of a part would mostly wait for each other. With more rays per thread, their
// data would not fit into a core's L2 cache.
#define THREAD_RAYS 8192
#define LEAST_RAYS  16384

// Returns the number of rays in a part.
static size_t part_rays(const RayBatch *batch, uint32_t threads)
{
    const size_t room = batch->results.hits.room, most = HITS_MAX / (room > 0 ? room : 1);
    size_t size = LEAST_RAYS;
    while (size < PART_RAYS && size < batch->rays.count && size < (size_t)threads * THREAD_RAYS)
        size *= 2;
    return most < size ? most : size;
}

// Casts the rays of the present part.
static bool cast(ClrtRenderer *renderer, RayQuery query, ClrtError *error)
{
    Error cause = {0};
    RayBatch *batch = renderer->batch;
    const RayScene *scene = ray_caster_scene(&renderer->caster, &renderer->session, query,
                                             batch->rays.one_sided, &cause);
    if (scene == NULL)
        return check_fail_for(error, CLRT_DEVICE, &cause);
    if (!ray_batch_convert(batch, scene, query == RAYS_CERTAIN, error))
        return false;
    const RayCast cast = {.query = query,
                          .scene = &scene->form.buffers,
                          .rays = batch->data,
                          .count = batch->count,
                          .on_surfaces = query == RAYS_NEAREST && batch->rays.starts != NULL,
                          .any = query == RAYS_NEAREST && batch->results.flags != NULL,
                          .room = (cl_uint)batch->results.hits.room,
                          .hits = batch->found,
                          .counts = batch->counts};
    return ray_caster_cast(&renderer->caster, &cast, &cause) ||
           check_fail_for(error, CLRT_DEVICE, &cause);
}

static bool trace_part(ClrtRenderer *renderer, ClrtError *error)
{
    RayBatch *batch = renderer->batch;
    uint8_t *certain = batch->results.hits.certain;
    if (!cast(renderer, batch->results.query, error))
        return false;
    ray_batch_store(batch);
    if (certain == NULL)
        return true;
    const bool ok = cast(renderer, RAYS_CERTAIN, error);
    for (size_t entry = 0; ok && entry < batch->count; entry++)
        certain[batch->first + batch->order[entry]] = batch->counts[entry] != 0;
    return ok;
}

static bool trace_parts(ClrtRenderer *renderer, size_t most, ClrtError *error)
{
    RayBatch *batch = renderer->batch;
    const ClrtRays *rays = &batch->rays;
    const size_t width = ray_order_width(rays);
    const uint64_t parts = (rays->count + most - 1) / most;
    for (uint64_t done = 0; done < parts; done++) {
        const size_t left = rays->count - done * most;
        batch->first = done * most;
        batch->count = left < most ? left : most;
        ray_order_fill(batch, width);
        if (!trace_part(renderer, error))
            return false;
        if (rays->progress != NULL && !rays->progress(rays->user, done + 1, parts) &&
            done + 1 < parts)
            return check_fail(error, CLRT_STOPPED, "the rays were stopped after %llu of %llu parts",
                              (unsigned long long)(done + 1), (unsigned long long)parts);
    }
    return true;
}

static bool trace_batch(ClrtRenderer *renderer, ClrtError *error)
{
    RayBatch *batch = renderer->batch;
    const bool are_many = batch->rays.count > LEAST_RAYS;
    const uint32_t threads =
        are_many ? threads_allowed(renderer->session.settings.wanted.threads) : 1;
    batch->pool = are_many ? thread_pool_open(threads) : NULL;
    const bool ok = trace_parts(renderer, part_rays(batch, threads), error);
    thread_pool_close(batch->pool);
    return ok;
}

static bool check_rays(ClrtRays *copy, const ClrtRays *rays, ClrtError *error)
{
    return check_struct(error, "the rays", rays, copy, sizeof *copy) &&
           (copy->count == 0 || check_given(error, "the origins", copy->origins));
}

// Makes the renderer's batch, unless it has one.
static bool make_batch(ClrtRenderer *renderer, ClrtError *error)
{
    Error cause = {0};
    if (renderer->batch == NULL)
        renderer->batch = memory_raw(1, sizeof *renderer->batch, &cause);
    return renderer->batch != NULL || check_fail_for(error, CLRT_DEVICE, &cause);
}

static bool trace(ClrtRenderer *renderer, const ClrtScene *scene, const ClrtRays *rays,
                  const RayResults *results, ClrtError *error)
{
    ClrtRays given;
    if (!renderer_handle_begin(renderer, scene, error))
        return false;
    bool ok = check_rays(&given, rays, error) && make_batch(renderer, error) &&
              renderer_handle_take(renderer, scene, error);
    if (ok) {
        renderer->batch->rays = given;
        renderer->batch->results = *results;
        ok = trace_batch(renderer, error);
    }
    renderer_handle_end(renderer);
    return ok;
}

bool clrt_trace(ClrtRenderer *renderer, const ClrtScene *scene, const ClrtRays *rays,
                const ClrtHits *hits, ClrtError *error)
{
    RayResults results = {.query = RAYS_NEAREST};
    if (!check_struct(error, "the hits", hits, &results.hits, sizeof results.hits))
        return false;
    results.hits.room = 1;
    return trace(renderer, scene, rays, &results, error);
}

bool clrt_trace_all(ClrtRenderer *renderer, const ClrtScene *scene, const ClrtRays *rays,
                    const ClrtHits *hits, ClrtError *error)
{
    RayResults results = {.query = RAYS_ALL};
    return check_struct(error, "the hits", hits, &results.hits, sizeof results.hits) &&
           check_number(error, "the room for hits", (double)results.hits.room, 0, HITS_MAX) &&
           (results.hits.certain == NULL ||
            check_fail(error, CLRT_ARGUMENT, "only clrt_trace finds which rays are certain")) &&
           trace(renderer, scene, rays, &results, error);
}

bool clrt_occluded(ClrtRenderer *renderer, const ClrtScene *scene, const ClrtRays *rays,
                   uint8_t *occluded, ClrtError *error)
{
    const RayResults results = {.query = RAYS_NEAREST, .hits.room = 1, .flags = occluded};
    return check_given(error, "the array of results", occluded) &&
           trace(renderer, scene, rays, &results, error);
}

bool clrt_contains(ClrtRenderer *renderer, const ClrtScene *scene, const ClrtRays *rays,
                   uint8_t *inside, ClrtError *error)
{
    const RayResults results = {.query = RAYS_ALL, .flags = inside};
    return check_given(error, "the array of results", inside) &&
           trace(renderer, scene, rays, &results, error);
}
