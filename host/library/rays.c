// SPDX-License-Identifier: MIT
// Implements clrt_trace, clrt_trace_all, clrt_contains and clrt_occluded. A batch of rays is traced
// part by part, so that batches of any size need little memory.
#include "library/ray_grid.h"
#include "library/ray_parts.h"

#include <stdlib.h>

// The caller's arrays for results.
typedef struct {
    ClrtHits hits;
    uint8_t *occluded, *inside; // NULL if not requested
    bool finds_all;             // finds all crossings instead of the nearest hits
} RayResults;

// A batch that is being traced.
typedef struct {
    ClrtRenderer *renderer;
    ClrtRays rays;
    RayResults results;
    RayPart part;
    uint32_t counts[PART_RAYS]; // crossings of each ray
    HitData certain[PART_RAYS]; // of RAYS_CERTAIN
    HitData *hits;              // room for one part
} Batch;

// Returns the number of hits that are kept for each ray.
static size_t room_of(const RayResults *results)
{
    return results->finds_all ? results->hits.room : 1;
}

static size_t part_rays(const RayResults *results)
{
    const size_t most = CROSSINGS_MAX / (room_of(results) > 0 ? room_of(results) : 1);
    return most < PART_RAYS ? most : PART_RAYS;
}

// Casts the rays that start on no primitive, then the rays that start on one. RAYS_CROSSED treats
// all rays alike.
static bool cast(Batch *batch, RayQuery query, const RayScene *scene, HitData *hits, Error *error)
{
    const RayPart *part = &batch->part;
    const RayCaster *caster = &batch->renderer->casters[query];
    const size_t split = part->count - (query == RAYS_CROSSED ? 0 : part->on_surface);
    RayCast cast = {.scene = &scene->buffers,
                    .rays = part->rays,
                    .count = split,
                    .any = batch->results.occluded != NULL,
                    .room = (uint32_t)part->room};
    if (!ray_caster_cast(caster, &cast, hits, batch->counts, error))
        return false;
    cast.rays += split;
    cast.count = part->count - split;
    cast.start = RAYS_ON_SURFACE;
    return cast.count == 0 || ray_caster_cast(caster, &cast, hits + split, NULL, error);
}

static bool trace_part(Batch *batch, Error *error)
{
    ClrtRenderer *renderer = batch->renderer;
    const RayQuery query = batch->results.finds_all ? RAYS_CROSSED : RAYS_NEAREST;
    if (!cast(batch, query, &renderer->rays, batch->hits, error))
        return false;
    if (batch->results.hits.certain == NULL)
        return true;
    ray_part_move(&batch->part, &renderer->certain_rays);
    return cast(batch, RAYS_CERTAIN, &renderer->certain_rays, batch->certain, error);
}

// Marks the entries beyond each ray's crossings as unused.
static void clear_unused(Batch *batch)
{
    const size_t room = batch->part.room;
    for (size_t entry = 0; entry < batch->part.count; entry++)
        for (size_t i = batch->counts[entry]; i < room; i++)
            batch->hits[entry * room + i] = (HitData){INFINITY, NOTHING};
}

// Stores the results that a ray has only once.
static void store_ray(const Batch *batch, size_t entry)
{
    const RayResults *results = &batch->results;
    const size_t ray = batch->part.first + batch->part.order[entry];
    if (results->occluded != NULL)
        results->occluded[ray] = batch->hits[entry].id != NOTHING;
    if (results->inside != NULL)
        results->inside[ray] = batch->counts[entry] % 2;
    if (results->hits.certain != NULL)
        results->hits.certain[ray] =
            batch->certain[entry].t == 0 && batch->certain[entry].id == batch->hits[entry].id;
    if (results->finds_all && results->hits.counts != NULL)
        results->hits.counts[ray] = batch->counts[entry];
}

static void store_part(Batch *batch)
{
    const RayResults *results = &batch->results;
    if (results->finds_all)
        clear_unused(batch);
    ray_part_store(&batch->part, &batch->renderer->rays, batch->hits, &results->hits);
    if (results->occluded != NULL || results->finds_all || results->hits.certain != NULL)
        for (size_t entry = 0; entry < batch->part.count; entry++)
            store_ray(batch, entry);
}

static bool trace_parts(Batch *batch, ClrtError *error)
{
    Error cause = {0};
    const ClrtRays *rays = &batch->rays;
    const size_t most = part_rays(&batch->results);
    const uint64_t parts = (rays->count + most - 1) / most;
    const size_t width = ray_grid_width(rays);
    for (uint64_t done = 0; done < parts; done++) {
        batch->part.first = done * most;
        batch->part.count = rays->count - batch->part.first;
        if (batch->part.count > most)
            batch->part.count = most;
        ray_grid_order(batch->part.sequence, batch->part.count, width);
        if (!ray_part_fill(&batch->part, batch->renderer, rays, error))
            return false;
        if (!trace_part(batch, &cause))
            return check_fail_for(error, CLRT_DEVICE, &cause);
        store_part(batch);
        if (rays->progress != NULL && !rays->progress(rays->user, done + 1, parts) &&
            done + 1 < parts)
            return check_fail(error, CLRT_STOPPED, "the rays were stopped after %llu of %llu parts",
                              (unsigned long long)(done + 1), (unsigned long long)parts);
    }
    return true;
}

// Opens the query's caster, and compiles the scene in the layout of the caster's kernel.
static bool prepare_query(const Batch *batch, RayQuery query, RayScene *scene, Error *error)
{
    Session *session = &batch->renderer->session;
    RayCaster *caster = &batch->renderer->casters[query];
    return (caster->kernel != NULL || ray_caster_open(caster, session, query, error)) &&
           ray_scene_take(scene, session, caster->kernel->choice.nodes, batch->rays.one_sided,
                          error);
}

static bool prepare(const Batch *batch, const ClrtScene *scene, ClrtError *error)
{
    Error cause = {0};
    ClrtRenderer *renderer = batch->renderer;
    if (!renderer_handle_take(renderer, scene, error))
        return false;
    const RayQuery query = batch->results.finds_all ? RAYS_CROSSED : RAYS_NEAREST;
    return (prepare_query(batch, query, &renderer->rays, &cause) &&
            (batch->results.hits.certain == NULL ||
             prepare_query(batch, RAYS_CERTAIN, &renderer->certain_rays, &cause))) ||
           check_fail_for(error, CLRT_DEVICE, &cause);
}

static bool trace(ClrtRenderer *renderer, const ClrtScene *scene, const ClrtRays *rays,
                  const RayResults *results, ClrtError *error)
{
    Error cause = {0};
    Batch *batch = memory_raw(1, sizeof *batch, &cause);
    if (batch == NULL)
        return check_fail_for(error, CLRT_DEVICE, &cause);
    batch->renderer = renderer;
    batch->results = *results;
    batch->part.room = room_of(results);
    batch->hits = memory_raw(part_rays(results) * room_of(results), sizeof *batch->hits, &cause);
    const bool ok =
        (batch->hits != NULL || check_fail_for(error, CLRT_DEVICE, &cause)) &&
        check_struct(error, "the rays", rays, &batch->rays, sizeof batch->rays) &&
        (batch->rays.count == 0 || check_given(error, "the origins", batch->rays.origins)) &&
        prepare(batch, scene, error) && trace_parts(batch, error);
    free(batch->hits);
    free(batch);
    return ok;
}

static bool trace_alone(ClrtRenderer *renderer, const ClrtScene *scene, const ClrtRays *rays,
                        const RayResults *results, ClrtError *error)
{
    if (!renderer_handle_begin(renderer, scene, error))
        return false;
    const bool ok = trace(renderer, scene, rays, results, error);
    renderer_handle_end(renderer);
    return ok;
}

bool clrt_trace(ClrtRenderer *renderer, const ClrtScene *scene, const ClrtRays *rays,
                const ClrtHits *hits, ClrtError *error)
{
    RayResults results = {0};
    return check_struct(error, "the hits", hits, &results.hits, sizeof results.hits) &&
           trace_alone(renderer, scene, rays, &results, error);
}

bool clrt_trace_all(ClrtRenderer *renderer, const ClrtScene *scene, const ClrtRays *rays,
                    const ClrtHits *hits, ClrtError *error)
{
    RayResults results = {.finds_all = true};
    return check_struct(error, "the hits", hits, &results.hits, sizeof results.hits) &&
           check_number(error, "the room for hits", (double)results.hits.room, 0, CROSSINGS_MAX) &&
           (results.hits.certain == NULL ||
            check_fail(error, CLRT_ARGUMENT, "only clrt_trace finds which rays are certain")) &&
           trace_alone(renderer, scene, rays, &results, error);
}

bool clrt_occluded(ClrtRenderer *renderer, const ClrtScene *scene, const ClrtRays *rays,
                   uint8_t *occluded, ClrtError *error)
{
    const RayResults results = {.occluded = occluded};
    return check_given(error, "the array of results", occluded) &&
           trace_alone(renderer, scene, rays, &results, error);
}

bool clrt_contains(ClrtRenderer *renderer, const ClrtScene *scene, const ClrtRays *rays,
                   uint8_t *inside, ClrtError *error)
{
    const RayResults results = {.inside = inside, .finds_all = true};
    return check_given(error, "the array of results", inside) &&
           trace_alone(renderer, scene, rays, &results, error);
}
