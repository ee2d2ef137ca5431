// SPDX-License-Identifier: MIT
// Traces arrays of rays for clrt check and the library, with the renderer's searches. Consecutive
// rays of an array may be random, and beams of random rays are slow. If the rays of a beam differ
// too much, they are therefore traced ray by ray. The file is compiled after render.cl, and only if
// requested.

// The arguments of trace_rays.
typedef struct {
    global const RayBlock *blocks;
    uint count, kinds;
    HitLists lists;
} RayArray;

#if CLRT_ALL_HITS
// Adds the crossings of rays in `starts` with the far walls of the spheres on which they start.
static inline void cross_own_spheres(const Tracer *tracer, const Ray *ray, Mask starts, Real limit)
{
    const Mask own = ray->active && starts && ray->own < tracer->frame->sphere_count;
    if (!any_lane(own))
        return;
    Ray leaving = *ray;
    leaving.kind = RAY_REFLECTED;
    const Sphere sphere = fetch_sphere(tracer, own ? ray->own : (UInt)(0));
    const Hit far = {own_sphere_distance(&sphere, &leaving, own), ray->own, NOTHING};
    add_crossings(tracer, ray, own, &far, limit);
}
#endif

// Reads the numbers of CLRT_LANES consecutive rays.
static inline UInt read_words(global const void *words)
{
#if CLRT_LANES == 1
    return *(global const uint *)words;
#else
    return FOR_LANES(vload)(0, (global const uint *)words);
#endif
}

static inline Real3 read_real3(global const float components[3][RAY_BLOCK], uint start)
{
    return real3_of(stored_real(read_words(components[0] + start)),
                    stored_real(read_words(components[1] + start)),
                    stored_real(read_words(components[2] + start)));
}

// Reads CLRT_LANES rays from index `first` on, one per lane. Lanes past the array's end are
// inactive, and so are rays with a limit below 0. *starts receives the lanes whose rays start on a
// primitive. If all hits count, *starts is 0, and these rays only skip the primitive.
static inline Ray ray_at(const Tracer *tracer, const RayArray *array, uint first, Hit *hit,
                         Mask *starts)
{
    global const RayBlock *block = array->blocks + first / RAY_BLOCK;
    const uint start = first % RAY_BLOCK;
    const UInt place = first + LANE_Y * PACKET_WIDTH + LANE_X;
    const UInt own = read_words(block->own + start), index = read_words(block->own_index + start);
    const Mask leaves =
        CLRT_ALL_HITS ? (Mask)(0) : index != NOTHING && own >= tracer->frame->sphere_count;
    *starts = index != NOTHING;
    *hit = (Hit){stored_real(read_words(block->limit + start)), NOTHING, NOTHING};
    Ray ray = {read_real3(block->origin, start),
               read_real3(block->direction, start),
               own,
               leaves ? index : (UInt)(NOTHING),
               RAY_CAMERA,
               place < array->count && hit->t >= 0.0f};
#if CLRT_ALL_HITS
    ray.number = place;
    cross_own_spheres(tracer, &ray, *starts, hit->t);
    *starts = 0;
#endif
    return ray;
}

// Calls meet_spheres, and returns the lanes that must then search. If the rays end at any hit,
// these lanes exclude hits on spheres.
static inline Mask begin_search(const Tracer *tracer, const Ray *ray, Hit *hit)
{
    const Mask searching = meet_spheres(tracer, ray, hit);
    return ends_at_any_hit(ray->kind) ? searching && hit->id == NOTHING : searching;
}

// Finds the hits of the rays in `active`. Sets the kind and the active lanes of `packets`.
static inline void search_rays(const Tracer *tracer, uint kind, const Mask active[PACKETS],
                               Ray packets[PACKETS], Hit hits[PACKETS])
{
    Mask searching[PACKETS];
    for (uint i = 0; i < PACKETS; i++) {
        packets[i].kind = (RayKind)kind;
        packets[i].active = active[i];
        searching[i] = begin_search(tracer, &packets[i], &hits[i]);
    }
    if (has_search(tracer))
        intersect_search(tracer, packets, searching, PACKETS, hits);
}

static inline void store_hits(global HitData *hits, uint left, const Hit *found)
{
    for (uint lane = 0; lane < CLRT_LANES && lane < left; lane++) {
        const uint id = ((const uint *)&found->id)[lane];
        const Scalar t = ((const Scalar *)&found->t)[lane];
        hits[lane] = (HitData){id == NOTHING ? INFINITY : (float)t, id};
    }
}

// Traces PACKETS packets of consecutive rays. The rays that start on no primitive search first.
// PoCL compiles a kernel's own code three times, but this function once.
static NOT_INLINE void trace_packets(const Tracer *tracer, const RayArray *array, uint first)
{
    Ray packets[PACKETS];
    Hit found[PACKETS];
    Mask active[2][PACKETS], starts;
    for (uint i = 0; i < PACKETS; i++) {
        packets[i] = ray_at(tracer, array, first + i * CLRT_LANES, &found[i], &starts);
        active[0][i] = packets[i].active && !starts;
        active[1][i] = packets[i].active && starts;
    }
    for (uint kind = array->kinds & ~RAY_ON_SURFACE; kind <= array->kinds; kind++)
        search_rays(tracer, kind, active[kind & RAY_ON_SURFACE], packets, found);
    for (uint i = 0; !CLRT_ALL_HITS && i < PACKETS; i++, first += CLRT_LANES)
        if (first < array->count)
            store_hits(array->lists.hits + first, array->count - first, &found[i]);
}

// Empties the lists of the rays from `first` to `end` - 1.
static inline void clear_lists(const HitLists *lists, uint first, uint end)
{
    for (uint ray = first; ray < end; ray++)
        lists->counts[ray] = 0;
    for (size_t entry = (size_t)first * lists->room; entry < (size_t)end * lists->room; entry++)
        lists->hits[entry] = (HitData){INFINITY, NOTHING};
}

// Finds the nearest hits of `count` rays. With CLRT_ALL_HITS, finds the nearest `room` hits of each
// ray and the number of all hits. Otherwise, `room` is 1, and any hits suffice if `kinds` has
// RAY_ANY_HIT. If rays start on primitives, `kinds` has RAY_ON_SURFACE. A work-item
// takes BLOCK * BLOCK consecutive rays, regardless of the number of lanes. If many work-items had
// no rays, PoCL would give all rays to one thread.
kernel void trace_rays(TRACER_ARGUMENTS, global const RayBlock *blocks, uint count, uint kinds,
                       uint room, global HitData *hits, global uint *counts)
{
    const RayArray array = {blocks, count, kinds, {hits, counts, room}};
    uint first = BLOCK * BLOCK * (uint)get_global_id(0);
    const uint end = min(first + BLOCK * BLOCK, count);
    Tally tally = {0};
#if CLRT_ALL_HITS
    tally.lists = array.lists;
    clear_lists(&array.lists, first, end);
#endif
    const Tracer tracer = TRACER(&tally);
    for (; first < end; first += PACKETS * CLRT_LANES)
        trace_packets(&tracer, &array, first);
}
