// SPDX-License-Identifier: MIT
// Traces arrays of rays for clrt check and the library, with the renderer's searches. Neighbors in
// an array may be random rays, for which beams are slow. If the rays of a beam differ too much,
// they are therefore traced ray by ray. The file is compiled after render.cl, and only if
// requested.

// Reads CLRT_LANES rays from index `start` on, one per lane. Lanes past the array's end are
// inactive, and so are rays with a limit below 0.
static inline Ray ray_at(global const RayData *rays, uint start, uint count, uint kind, Hit *limit)
{
    const UInt place = start + LANE_Y * PACKET_WIDTH + LANE_X;
    const Record record = record_at(rays, min(place, (UInt)(count - 1)) * WORDS(RayData));
    *limit = (Hit){record_real(&record, 3), NOTHING, NOTHING};
    return (Ray){record_real3(&record, 0, 1),
                 record_real3(&record, 4, 1),
                 record_word(&record, 7),
                 record_word(&record, 8),
                 kind,
                 place < count && limit->t >= 0.0f};
}

// Finds the nearest sphere before hit->t, unless the search finds it. Returns the lanes that then
// search.
static inline Mask begin_search(const Tracer *tracer, const Ray *ray, Hit *hit)
{
    const Mask searching = meet_spheres(tracer, ray, hit);
    return ends_at_any_hit(ray->kind) ? searching && hit->id == NOTHING : searching;
}

static inline void search_rays(const Tracer *tracer, const Ray packets[PACKETS], Hit hits[PACKETS])
{
    Mask searching[PACKETS];
    for (uint i = 0; i < PACKETS; i++)
        searching[i] = begin_search(tracer, &packets[i], &hits[i]);
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

// The arguments of trace_rays.
typedef struct {
    global const RayData *rays;
    uint count, kind;
    global HitData *hits;
} RayArray;

// Traces PACKETS packets of consecutive rays. PoCL compiles a kernel's own code three times, but
// this function once.
static NOT_INLINE void trace_packets(const Tracer *tracer, const RayArray *array, uint start)
{
    const uint count = array->count;
    Ray packets[PACKETS];
    Hit found[PACKETS];
    for (uint i = 0; i < PACKETS; i++)
        packets[i] = ray_at(array->rays, start + i * CLRT_LANES, count, array->kind, &found[i]);
    search_rays(tracer, packets, found);
    for (uint i = 0; i < PACKETS && start + i * CLRT_LANES < count; i++)
        store_hits(array->hits + start + i * CLRT_LANES, count - start - i * CLRT_LANES, &found[i]);
}

// Finds the nearest hits of `count` rays, or any hits if `kind` has RAY_ANY_HIT. All rays have the
// same kind (RayKind). A work-item takes BLOCK * BLOCK consecutive rays, regardless of the number
// of lanes. If many work-items had no rays, PoCL would give all rays to one thread.
kernel void trace_rays(TRACER_ARGUMENTS, global const RayData *rays, uint count, uint kind,
                       global HitData *hits)
{
    const uint begin = BLOCK * BLOCK * (uint)get_global_id(0);
    Tally tally = {0};
    const Tracer tracer = TRACER(&tally);
    const RayArray array = {rays, count, kind, hits};
    for (uint start = begin; start < min(begin + BLOCK * BLOCK, count);
         start += PACKETS * CLRT_LANES)
        trace_packets(&tracer, &array, start);
}
