// SPDX-License-Identifier: MIT
// Implements clrt_trace, clrt_trace_all, clrt_contains and clrt_occluded. A batch of rays is traced
// part by part, so that batches of any size need little memory.
#include "base/thread_pool.h"
#include "library/ray_grid.h"
#include "library/ray_parts.h"

#include <stdlib.h>

// The caller's arrays for results.
typedef struct {
    RayQuery query; // RAYS_NEAREST or RAYS_CROSSED
    ClrtHits hits;  // room is 1 for RAYS_NEAREST
    uint8_t *flags; // whether a ray is occluded, or starts inside of the meshes; may be NULL
} RayResults;

typedef struct {
    ClrtRenderer *renderer;
    ClrtRays rays;
    RayResults results;
    size_t most; // rays in a part
    RayPart part;
    uint32_t counts[PART_RAYS]; // crossings of each ray
    HitData certain[PART_RAYS]; // of RAYS_CERTAIN
    HitData hits[];             // results.hits.room for each ray of a part
} Batch;

// With fewer rays per thread, a part would mostly wait for threads. With more, its arrays would not
// fit into the second cache of one core.
#define THREAD_RAYS 8192
#define LEAST_RAYS  16384

// Returns the number of rays in a part. Few rays need no threads.
static size_t part_rays(const RayResults *results, size_t rays, uint32_t threads)
{
    const size_t room = results->hits.room, most = CROSSINGS_MAX / (room > 0 ? room : 1);
    size_t size = LEAST_RAYS;
    while (size < PART_RAYS && size < rays && size < (size_t)threads * THREAD_RAYS)
        size *= 2;
    return most < size ? most : size;
}

// Opens the query's caster, and compiles the scene in the layout of the caster's kernel.
static bool prepare(const Batch *batch, RayQuery query, ClrtError *error)
{
    Error cause = {0};
    Session *session = &batch->renderer->session;
    RayCaster *caster = &batch->renderer->casters[query];
    return ((caster->kernel != NULL || ray_caster_open(caster, session, query, &cause)) &&
            ray_scene_take(renderer_handle_rays(batch->renderer, query), session,
                           caster->kernel->choice.nodes, batch->rays.one_sided, &cause)) ||
           check_fail_for(error, CLRT_DEVICE, &cause);
}

static bool cast(Batch *batch, RayQuery query, HitData *hits, ClrtError *error)
{
    Error cause = {0};
    RayPart *part = &batch->part;
    const RayScene *scene = renderer_handle_rays(batch->renderer, query);
    const RayCast cast = {.scene = &scene->form.buffers,
                          .rays = part->rays,
                          .count = part->count,
                          .start = part->start,
                          .any = batch->results.flags != NULL,
                          .room = (uint32_t)part->room};
    ray_part_index(part, scene);
    return ray_caster_cast(&batch->renderer->casters[query], &cast, hits, batch->counts, &cause) ||
           check_fail_for(error, CLRT_DEVICE, &cause);
}

// Stores the results that have one entry per ray, whatever room is: flags, certain and counts.
static void store_ray(const Batch *batch, size_t entry)
{
    const RayResults *results = &batch->results;
    const ClrtHits *hits = &results->hits;
    const HitData *certain = &batch->certain[entry];
    const bool all = results->query == RAYS_CROSSED;
    const size_t ray = ray_part_number(&batch->part, entry);
    if (results->flags != NULL)
        results->flags[ray] =
            all ? (batch->counts[entry] & 1) != 0 : batch->hits[entry].id != NOTHING;
    if (hits->certain != NULL)
        hits->certain[ray] = certain->t == 0 && certain->id == batch->hits[entry].id;
    if (all && hits->counts != NULL)
        hits->counts[ray] = batch->counts[entry];
}

// Traces the part's rays whose kind of start is `start`.
static bool trace_part(Batch *batch, RayStart start, ClrtError *error)
{
    RayPart *part = &batch->part;
    const RayResults *results = &batch->results;
    const ClrtHits *hits = &results->hits;
    part->start = start;
    if (!ray_part_fill(part, &batch->rays, error))
        return false;
    if (part->count == 0)
        return true;
    if (!cast(batch, results->query, batch->hits, error) ||
        (hits->certain != NULL && !cast(batch, RAYS_CERTAIN, batch->certain, error)))
        return false;
    ray_part_store(part, batch->hits, hits);
    if (results->flags != NULL || hits->certain != NULL || hits->counts != NULL)
        for (size_t entry = 0; entry < part->count; entry++)
            store_ray(batch, entry);
    return true;
}

static bool trace_parts(Batch *batch, ClrtError *error)
{
    RayPart *part = &batch->part;
    const ClrtRays *rays = &batch->rays;
    const size_t most = batch->most, width = ray_grid_width(rays);
    const uint64_t parts = (rays->count + most - 1) / most;
    for (uint64_t done = 0; done < parts; done++) {
        const size_t left = rays->count - done * most;
        part->first = done * most;
        part->size = left < most ? left : most;
        ray_grid_order(part->sequence, part->size, width);
        if (!trace_part(batch, RAYS_FREE, error) ||
            (rays->starts != NULL && !trace_part(batch, RAYS_ON_SURFACE, error)))
            return false;
        if (rays->progress != NULL && !rays->progress(rays->user, done + 1, parts) &&
            done + 1 < parts)
            return check_fail(error, CLRT_STOPPED, "the rays were stopped after %llu of %llu parts",
                              (unsigned long long)(done + 1), (unsigned long long)parts);
    }
    return true;
}

static bool trace_batch(Batch *batch, const ClrtScene *scene, ClrtError *error)
{
    const RayResults *results = &batch->results;
    if (!renderer_handle_take(batch->renderer, scene, error) ||
        !prepare(batch, results->query, error) ||
        (results->hits.certain != NULL && !prepare(batch, RAYS_CERTAIN, error)))
        return false;
    ray_part_begin(&batch->part, &batch->renderer->session,
                   renderer_handle_rays(batch->renderer, results->query), results->hits.room);
    return trace_parts(batch, error);
}

static bool check_rays(ClrtRays *copy, const ClrtRays *rays, ClrtError *error)
{
    return check_struct(error, "the rays", rays, copy, sizeof *copy) &&
           (copy->count == 0 || check_given(error, "the origins", copy->origins));
}

// Returns the renderer's memory for a batch of rays.
static Batch *take_memory(ClrtRenderer *renderer, size_t size, ClrtError *error)
{
    Error cause = {0};
    if (renderer->ray_memory_size < size) {
        free(renderer->ray_memory);
        renderer->ray_memory = memory_raw(1, size, &cause);
        renderer->ray_memory_size = renderer->ray_memory != NULL ? size : 0;
    }
    if (renderer->ray_memory == NULL)
        check_fail_for(error, CLRT_DEVICE, &cause);
    return renderer->ray_memory;
}

static bool trace_given(ClrtRenderer *renderer, const ClrtScene *scene, const ClrtRays *rays,
                        const RayResults *results, ClrtError *error)
{
    ClrtRays given;
    if (!check_rays(&given, rays, error))
        return false;
    const bool are_many = given.count > LEAST_RAYS;
    const uint32_t threads =
        are_many ? threads_allowed(renderer->session.settings.wanted.threads) : 1;
    const size_t most = part_rays(results, given.count, threads);
    Batch *batch = take_memory(
        renderer, sizeof *batch + most * results->hits.room * sizeof *batch->hits, error);
    if (batch == NULL)
        return false;
    batch->renderer = renderer;
    batch->rays = given;
    batch->results = *results;
    batch->most = most;
    batch->part.pool = are_many ? thread_pool_open(threads) : NULL;
    const bool ok = trace_batch(batch, scene, error);
    thread_pool_close(batch->part.pool);
    return ok;
}

static bool trace(ClrtRenderer *renderer, const ClrtScene *scene, const ClrtRays *rays,
                  const RayResults *results, ClrtError *error)
{
    if (!renderer_handle_begin(renderer, scene, error))
        return false;
    const bool ok = trace_given(renderer, scene, rays, results, error);
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
    RayResults results = {.query = RAYS_CROSSED};
    return check_struct(error, "the hits", hits, &results.hits, sizeof results.hits) &&
           check_number(error, "the room for hits", (double)results.hits.room, 0, CROSSINGS_MAX) &&
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
    const RayResults results = {.query = RAYS_CROSSED, .flags = inside};
    return check_given(error, "the array of results", inside) &&
           trace(renderer, scene, rays, &results, error);
}
