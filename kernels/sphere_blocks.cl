// SPDX-License-Identifier: MIT
// Tests blocks of spheres. Few rays of a packet come near each sphere of a block, but a two-float
// test takes as long for one lane as for all lanes. Rays and spheres that plain Reals do not
// separate are therefore collected as pairs, and each lane tests a pair. With AVX2, pictures of 100
// to 10,000 balls take 4 to 7 % less time than with two-float tests of whole packets.
//
// Pairs wait until they fill all lanes or the search ends. Until then, an upper bound on the
// distance limits the search. With AVX2, this saves another 3 to 13 % of the time.
//
// Invariant: pairs are tested by the operations of spheres.cl, and bounds only cull, so pairing
// changes no nearest hit. A search for any hit ends at a certain hit, and may store its bound.
#ifndef CLRT_SPHERE_BLOCKS_CL
#define CLRT_SPHERE_BLOCKS_CL
#include "fetch.cl"
#include "spheres.cl"
#include "wide_stack.cl"

#if CLRT_WIDE_NODES

static inline global const SphereBlock *sphere_block(const Tracer *tracer, uint child)
{
    global const SphereBlock *blocks =
        (global const SphereBlock *)(tracer->spheres + tracer->frame->sphere_count);
    return blocks + (child & ~WIDE_SPHERES);
}

// Returns the same sphere of a block in all lanes.
static inline Sphere block_sphere(global const SphereBlock *block, uint slot)
{
    return (Sphere){{two_stored(block->center[0][slot], block->center_low[0][slot]),
                     two_stored(block->center[1][slot], block->center_low[1][slot]),
                     two_stored(block->center[2][slot], block->center_low[2][slot])},
                    two_stored(block->radius[slot], block->radius_low[slot])};
}

// Reads CLRT_LANES numbers of a row. 16 lanes get the row twice.
#if CLRT_LANES == 16
#define ROW_LANES(type, row) ((type)(vload8(0, row), vload8(0, row)))
#elif CLRT_LANES == 8
#define ROW_LANES(type, row) vload8(0, row)
#else
#define ROW_LANES(type, row) vload4(0, row)
#endif

static inline TwoFloat row_pair(global const float *high, global const float *low)
{
    return (TwoFloat){ROW_LANES(Real, high), ROW_LANES(Real, low)};
}

// Returns the spheres of a block from slot `first` on, one per lane.
static inline Sphere block_spheres(global const SphereBlock *block, uint first)
{
    return (Sphere){{row_pair(block->center[0] + first, block->center_low[0] + first),
                     row_pair(block->center[1] + first, block->center_low[1] + first),
                     row_pair(block->center[2] + first, block->center_low[2] + first)},
                    row_pair(block->radius + first, block->radius_low + first)};
}

// A pair has the number of a ray, which is CLRT_LANES * packet + lane, and the place of a sphere in
// the words of all blocks.
typedef struct {
    const Tracer *tracer;
    const Ray *rays; // packets
    Hit *hits;       // of the packets
    uint count;      // pairs
    uint ray[2 * CLRT_LANES + WIDE], sphere[2 * CLRT_LANES + WIDE];
    uint changed[PACKETS]; // bits of the lanes whose hits changed
} SpherePairs;

static inline void start_pairs(SpherePairs *pairs, const Tracer *tracer, const Ray *rays, Hit *hits)
{
    pairs->tracer = tracer;
    pairs->rays = rays;
    pairs->hits = hits;
    pairs->count = 0;
    for (uint packet = 0; packet < PACKETS; packet++)
        pairs->changed[packet] = 0;
}

static inline UInt ray_word(const Ray *rays, UInt place, uint word)
{
    const uint *words = (const uint *)rays + word * CLRT_LANES;
    return (UInt)(FOR_LANES(GATHER_)(place));
}

static inline Real3 ray_vector(const Ray *rays, UInt place, uint word)
{
    return real3_of(as_real(ray_word(rays, place, word)), as_real(ray_word(rays, place, word + 1)),
                    as_real(ray_word(rays, place, word + 2)));
}

// Returns the rays with the numbers `number`, one per lane.
static inline Ray gathered_rays(const Ray *rays, UInt number, Mask active)
{
    const UInt place = number / CLRT_LANES * WORDS(Ray) + number % CLRT_LANES;
    return (Ray){ray_vector(rays, place, 0),
                 ray_vector(rays, place, 3),
                 ray_word(rays, place, 6),
                 NOTHING,
                 rays->kind,
                 active};
}

static inline TwoFloat gathered_row(global const uint *words, UInt place, uint row)
{
    return (TwoFloat){stored_real(gather(words + row * WIDE, place)),
                      stored_real(gather(words + (row + 4) * WIDE, place))};
}

static inline Sphere gathered_spheres(global const uint *words, UInt place)
{
    return (Sphere){{gathered_row(words, place, 0), gathered_row(words, place, 1),
                     gathered_row(words, place, 2)},
                    gathered_row(words, place, 3)};
}

// Makes a sphere the best hit of a ray if it precedes the best hit so far.
static inline void accept_pair(SpherePairs *pairs, uint number, Real t, uint id)
{
    const uint packet = number / CLRT_LANES, lane = number % CLRT_LANES;
    Hit *best = &pairs->hits[packet];
    accept_sphere(lanes_of(1u << lane) ? t : INFINITY, id, best);
    pairs->changed[packet] |= (lane_uint(&best->id, lane) == id ? 1u : 0u) << lane;
}

// Adds the crossings of the given pairs.
static inline void cross_pairs(const SpherePairs *pairs, UInt number, UInt ids, Mask given,
                               const SphereWalls *walls)
{
    for (uint bits = lane_bits(given); bits != 0; bits &= bits - 1) {
        const uint i = lowest_bit(bits), ray = lane_uint(&number, i);
        Ray alone = pairs->rays[ray / CLRT_LANES];
        alone.active = lanes_of(1u << ray % CLRT_LANES);
        const SphereWalls both = {lane_real(&walls->near, i), lane_real(&walls->far, i)};
        cross_walls(pairs->tracer, &alone, &both, lane_uint(&ids, i),
                    pairs->hits[ray / CLRT_LANES].t);
    }
}

// Tests and removes the last CLRT_LANES pairs, or all if there are fewer.
static NOT_INLINE void test_pairs(SpherePairs *pairs)
{
    const uint count = min(pairs->count, (uint)CLRT_LANES);
    pairs->count -= count;
    const Mask valid = lanes_of((1u << count) - 1);
    const UInt number = valid ? FOR_LANES(vload)(0, pairs->ray + pairs->count) : (UInt)(0);
    const UInt place = valid ? FOR_LANES(vload)(0, pairs->sphere + pairs->count) : (UInt)(0);
    global const uint *words = (global const uint *)sphere_block(pairs->tracer, WIDE_SPHERES);
    const Sphere spheres = gathered_spheres(words, place);
    const UInt ids = gather(words + 8 * WIDE, place);
    const Ray ray = gathered_rays(pairs->rays, number, valid);
    const Mask is_own = valid && ray.own == ids;
    if (CLRT_ALL_HITS) {
        const SphereWalls walls = exact_sphere_walls(&spheres, ray.origin, ray.direction);
        cross_pairs(pairs, number, ids, valid && !is_own, &walls);
        return;
    }
    const Real other = exact_sphere_distance(&spheres, ray.origin, ray.direction);
    const Real t = is_own ? own_sphere_distance(&spheres, &ray, is_own) : other;
    for (uint found = lane_bits(valid && t < INFINITY); found != 0; found &= found - 1) {
        const uint i = lowest_bit(found);
        accept_pair(pairs, lane_uint(&number, i), lane_real(&t, i), lane_uint(&ids, i));
    }
}

// Limits a ray's search to `reach`, an upper bound on its distance to the sphere with the given id.
// Returns whether this ends the search.
static inline bool limit_ray(SpherePairs *pairs, uint number, float reach, uint id)
{
    const uint packet = number / CLRT_LANES, lane = number % CLRT_LANES;
    Hit *best = &pairs->hits[packet];
    if (!(reach < lane_real(&best->t, lane)))
        return false;
    ((float *)&best->t)[lane] = reach;
    pairs->changed[packet] |= 1u << lane;
    if (!ends_at_any_hit(pairs->rays[packet].kind))
        return false;
    ((uint *)&best->id)[lane] = id;
    ((uint *)&best->index)[lane] = id;
    return true;
}

// Appends a pair, unless `reach` ends the ray's search (limit_ray).
static inline void append_pair(SpherePairs *pairs, uint number, uint child, uint slot, float reach)
{
    if (limit_ray(pairs, number, reach, sphere_block(pairs->tracer, child)->id[slot]))
        return;
    pairs->ray[pairs->count] = number;
    pairs->sphere[pairs->count] = (child & ~WIDE_SPHERES) * WORDS(SphereBlock) + slot;
    pairs->count++;
}

// Returns the active lanes, except lanes in which plain Reals prove that the ray misses the sphere.
// There are no branches, because processors could not predict them.
static inline Mask may_hit_sphere(const Sphere *sphere, const Ray *ray, UInt id)
{
    const Mask away = leads_away(sphere, ray->origin, ray->direction);
    const Mask returns = may_hit_own_sphere(ray->kind) ? !away : (Mask)(0);
    const Mask is_near = !sphere_is_passed(sphere, ray->origin, ray->direction) &&
                         !(away && plain_side(sphere, ray->origin) > 0);
    return ray->active && (ray->own == id ? returns : is_near);
}

// Returns certain_reach for rays that do not start on the sphere, and INFINITY for others. In
// programs that find all hits, no hit limits the search.
static inline Real pair_reach(const Sphere *sphere, const Ray *ray, UInt id)
{
    const Real reach =
        CLRT_ALL_HITS ? INFINITY : certain_reach(sphere, ray->origin, ray->direction);
    return ray->own == id ? INFINITY : reach;
}

// Returns one lane's ray in all lanes. No lane is active.
static inline Ray one_ray(const Ray *ray, uint lane)
{
    const Real3 *o = &ray->origin, *d = &ray->direction;
    return (Ray){{lane_real(&o->x, lane), lane_real(&o->y, lane), lane_real(&o->z, lane)},
                 {lane_real(&d->x, lane), lane_real(&d->y, lane), lane_real(&d->z, lane)},
                 (UInt)(lane_uint(&ray->own, lane)),
                 NOTHING,
                 ray->kind,
                 0};
}

// Returns the bits of the block's spheres that the lane's ray may hit. Stores pair_reach for these
// spheres.
static ALWAYS_INLINE uint spheres_near(global const SphereBlock *block, const Ray *packet,
                                       uint lane, float reach[])
{
    Ray ray = one_ray(packet, lane);
    uint near = 0;
    for (uint first = 0; first < WIDE; first += CLRT_LANES) {
        const UInt ids = ROW_LANES(UInt, block->id + first);
        const Sphere spheres = block_spheres(block, first);
        ray.active = lanes_of((1u << WIDE) - 1) && ids != NOTHING;
        const uint found = lane_bits(may_hit_sphere(&spheres, &ray, ids));
        if (found != 0)
            FOR_LANES(vstore)(pair_reach(&spheres, &ray, ids), 0, reach + first);
        near |= found << first;
    }
    return near;
}

// Finds the pairs of a ray and the spheres of a block. Inlining both calls saves 2 % of the time of
// 10,000 balls with AVX2.
static ALWAYS_INLINE void pair_ray(SpherePairs *pairs, uint packet, uint lane, uint child)
{
    global const SphereBlock *block = sphere_block(pairs->tracer, child);
    float reach[CLRT_LANES > WIDE ? CLRT_LANES : WIDE];
    uint near = spheres_near(block, &pairs->rays[packet], lane, reach);
    for (; near != 0; near &= near - 1)
        append_pair(pairs, packet * CLRT_LANES + lane, child, lowest_bit(near),
                    reach[lowest_bit(near)]);
    while (pairs->count >= CLRT_LANES)
        test_pairs(pairs);
    if (CLRT_STATISTICS)
        pairs->tracer->tally->sphere_tests += WIDE;
}

// Finds the pairs of a packet's rays, in the lanes whose bits are set, and the spheres of a block.
static inline void pair_packet(SpherePairs *pairs, uint packet, uint bits, uint child)
{
    global const SphereBlock *block = sphere_block(pairs->tracer, child);
    Ray ray = pairs->rays[packet];
    uint near[WIDE];
    Real reach[WIDE];
    ray.active = lanes_of(bits);
    for (uint slot = 0; slot < WIDE; slot++) {
        const Sphere sphere = block_sphere(block, slot);
        const UInt id = block->id[slot];
        near[slot] = lane_bits(may_hit_sphere(&sphere, &ray, id));
        if (near[slot] != 0)
            reach[slot] = pair_reach(&sphere, &ray, id);
    }
    for (uint slot = 0; slot < WIDE && block->id[slot] != NOTHING; slot++) {
        for (; near[slot] != 0; near[slot] &= near[slot] - 1)
            append_pair(pairs, packet * CLRT_LANES + lowest_bit(near[slot]), child, slot,
                        lane_real(&reach[slot], lowest_bit(near[slot])));
        if (pairs->count >= CLRT_LANES)
            test_pairs(pairs);
        if (CLRT_STATISTICS)
            pairs->tracer->tally->sphere_tests += popcount(bits);
    }
}

// Appends a pair for each given lane of a packet and each sphere of a block that the lane's ray may
// hit. If many lanes are given, each sphere is tested against all of them at once. Otherwise, each
// lane's ray is tested against all spheres at once.
static inline void pair_lanes(SpherePairs *pairs, uint packet, uint bits, uint child)
{
    if (popcount(bits) >= WIDE - 1)
        pair_packet(pairs, packet, bits, child);
    else
        for (; bits != 0; bits &= bits - 1)
            pair_ray(pairs, packet, lowest_bit(bits), child);
}

static inline void finish_pairs(SpherePairs *pairs)
{
    while (pairs->count > 0)
        test_pairs(pairs);
}

#endif
#endif
