// SPDX-License-Identifier: MIT
// Converts the device's hits to the caller's coordinates, and computes weights and normals in fp64.
#include "library/ray_results.h"

#include <string.h>

// Stores the barycentric weights of the second and third corner at the point where the ray's line
// crosses the triangle's plane (Moeller and Trumbore, JGT 2(1) 1997). Rounding can put the point
// outside the triangle, so the weights are clamped.
INLINED void weights_at(double weights[2], const Face *face, Vec3 origin, Vec3 direction)
{
    const Vec3 ab = vec3_sub(face->at[1], face->at[0]), ac = vec3_sub(face->at[2], face->at[0]);
    const Vec3 from = vec3_sub(origin, face->at[0]), across = vec3_cross(direction, ac);
    const double determinant = vec3_dot(ab, across);
    if (determinant == 0)
        return;
    const double second = vec3_dot(from, across) / determinant;
    const double third = vec3_dot(direction, vec3_cross(from, ab)) / determinant;
    weights[0] = fmin(fmax(second, 0), 1);
    weights[1] = fmin(fmax(third, 0), 1 - weights[0]);
}

static Vec3 sphere_normal(const SphereData *sphere, Vec3 point)
{
    const Vec3 center =
        vec3_add(vec3_of_floats(sphere->center), vec3_of_floats(sphere->center_low));
    return vec3_normalize(vec3_sub(point, center));
}

static inline Vec3 stored_vector(const float *components, size_t i)
{
    return vec3((double)components[i], (double)components[RAY_BLOCK + i],
                (double)components[2 * RAY_BLOCK + i]);
}

// Stores an array's value for a hit. `to` is the hit's place in the caller's arrays.
typedef void StoreHit(const RayBatch *batch, size_t entry, HitData hit, size_t to);

INLINED void store_distance(const RayBatch *batch, size_t entry, HitData hit, size_t to)
{
    const double t = batch->starts[entry] + (double)hit.t;
    batch->results.hits.distances[to] = hit.id == NOTHING ? INFINITY : t * batch->units[entry];
}

INLINED void store_primitive(const RayBatch *batch, size_t entry, HitData hit, size_t to)
{
    (void)entry;
    batch->results.hits.primitives[to] = hit.id;
}

INLINED void store_place(const RayBatch *batch, size_t entry, HitData hit, size_t to)
{
    static const TrianglePlace nowhere = {NOTHING, NOTHING, NOTHING};
    const ClrtHits *hits = &batch->results.hits;
    const uint32_t spheres = batch->scene->form.flat.sphere_count;
    const TrianglePlace *place =
        hit.id != NOTHING && hit.id >= spheres ? &batch->scene->places[hit.id - spheres] : &nowhere;
    (void)entry;
    if (hits->meshes != NULL)
        hits->meshes[to] = place->mesh;
    if (hits->triangles != NULL)
        hits->triangles[to] = place->number;
}

INLINED void store_surface(const RayBatch *batch, size_t entry, HitData hit, size_t to)
{
    const ClrtHits *hits = &batch->results.hits;
    const RayBlock *block = (const RayBlock *)batch->caster->blocks.data + entry / RAY_BLOCK;
    const FlatScene *flat = &batch->scene->form.flat;
    const Vec3 origin = stored_vector(block->origin[0], entry % RAY_BLOCK);
    const Vec3 direction = stored_vector(block->direction[0], entry % RAY_BLOCK);
    double weights[2] = {0, 0};
    Vec3 normal = {0, 0, 0};
    if (hit.id != NOTHING && hit.id < flat->sphere_count) {
        normal = sphere_normal(&flat->spheres[hit.id], point_at(origin, direction, (double)hit.t));
    } else if (hit.id != NOTHING) {
        const Face face = face_of(batch->scene, hit.id);
        weights_at(weights, &face, origin, direction);
        normal = face.normal;
    }
    if (hits->weights != NULL)
        memcpy(hits->weights + 2 * to, weights, sizeof weights);
    if (hits->normals != NULL)
        vec3_store_doubles(hits->normals + 3 * to, normal);
    if (hits->fronts != NULL)
        hits->fronts[to] = hit.id != NOTHING && vec3_dot(normal, direction) <= 0;
}

// The entries from `first` to `end` - 1, with `room` hits each.
typedef struct {
    size_t first, end, room;
} HitRange;

INLINED void store_each(const RayBatch *batch, HitRange range, StoreHit *store)
{
    const HitData *found = batch->caster->hits.data;
    for (size_t entry = range.first; entry < range.end; entry++) {
        const size_t ray = ray_of(batch, entry);
        for (size_t i = 0; i < range.room; i++)
            store(batch, entry, found[entry * range.room + i], ray * range.room + i);
    }
}

// Separate loops take half as long as a single loop that fills all arrays.
INLINED void store_hits(const RayBatch *batch, HitRange range)
{
    const ClrtHits *hits = &batch->results.hits;
    if (hits->distances != NULL)
        store_each(batch, range, store_distance);
    if (hits->primitives != NULL)
        store_each(batch, range, store_primitive);
    if (hits->meshes != NULL || hits->triangles != NULL)
        store_each(batch, range, store_place);
    if (hits->weights != NULL || hits->normals != NULL || hits->fronts != NULL)
        store_each(batch, range, store_surface);
}

FOR_AVX2_TOO static void store_range(void *context, uint32_t first, uint32_t end)
{
    const RayBatch *batch = context;
    const RayResults *results = &batch->results;
    const size_t room = results->hits.room;
    const bool is_certain = batch->cast.query == RAYS_CERTAIN;
    const bool is_nearest = batch->cast.query == RAYS_NEAREST;
    const HitData *found = batch->caster->hits.data;
    const uint32_t *counts = batch->caster->counts.data;
    uint8_t *flags = is_certain ? results->hits.certain : results->flags;
    for (size_t entry = first; flags != NULL && entry < end; entry++)
        flags[ray_of(batch, entry)] =
            is_nearest ? found[entry].id != NOTHING : counts[entry] % 2 != 0;
    for (size_t entry = first; results->hits.counts != NULL && entry < end; entry++)
        results->hits.counts[ray_of(batch, entry)] = counts[entry];
    // Compiling this case separately saves 4 % of a call for camera rays.
    if (room == 1 && !is_certain)
        store_hits(batch, (HitRange){first, end, 1});
    else if (!is_certain)
        store_hits(batch, (HitRange){first, end, room});
}

void ray_results_store(RayBatch *batch)
{
    thread_pool_share(batch->pool, batch->cast.count, RANGE_ENTRIES, store_range, batch);
}
