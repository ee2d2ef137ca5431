// SPDX-License-Identifier: MIT
// Finds all triangles that a ray crosses. If a ray crosses an odd number of triangles of a closed,
// two-sided surface, the ray starts inside the surface.
//
// A ray through an edge or a vertex hits several triangles there. If all of them counted, the
// parity could be wrong. A triangle therefore counts only if it owns the ray. edges_own decides as
// if the ray were moved by an infinitely small distance in a fixed direction (Edelsbrunner and
// Muecke, "Simulation of simplicity", 1990).
//
// Invariant: if a ray crosses a closed surface at an edge or vertex, an odd number of the triangles
// there own the ray. If the ray only touches the surface there, the number is even.
//
// A work-item follows one ray through the same tree as the other searches, but never stops before
// the ray's limit. The file is compiled after render.cl, and only if requested.

// The number of a ray's crossings, and the nearest `room` of them, sorted by distance and id.
typedef struct {
    global HitData *nearest;
    uint room, count;
} Crossings;

static inline bool precedes(const HitData *a, const HitData *b)
{
    return a->t < b->t || (a->t == b->t && a->id < b->id);
}

static inline void add_crossing(Crossings *crossings, HitData hit)
{
    uint place = min(crossings->count, crossings->room);
    crossings->count++;
    for (; place > 0; place--) {
        const HitData before = crossings->nearest[place - 1];
        if (!precedes(&hit, &before))
            break;
        if (place < crossings->room)
            crossings->nearest[place] = before;
    }
    if (place < crossings->room)
        crossings->nearest[place] = hit;
}

#if CLRT_WIDE_NODES
typedef struct {
    Search search;
    NearPlanes planes;
    LaneRay lane;
    float limit;
    uint own;
} CrossingRay;

static inline void cross_block(const CrossingRay *ray, uint number, Crossings *crossings)
{
    global const TriangleBlock *block = ray->search.tracer->triangles + number;
    const WideCorners relative = {block_corner_relative(block, 0, &ray->lane),
                                  block_corner_relative(block, 1, &ray->lane),
                                  block_corner_relative(block, 2, &ray->lane)};
    const WideCorners sheared = corners_sheared(&relative, &ray->lane.shear);
    const WideEdges edges = edges_of(&sheared);
    const int8 owned = edges_own(&sheared, &edges);
    if (lane_bits(owned) == 0)
        return;
    const float8 t = triangle_depth(&sheared, &edges) * ray->lane.shear.inverse_z;
    const uint8 id = vload8(0, block->id);
    const int8 front = edges_face(&edges, &ray->lane.shear);
    const int8 inner = front == ((id & TRIANGLE_REVERSED) != 0);
    const int8 open = (id & TRIANGLE_TWO_SIDED) == 0 && inner;
    const int8 own = (id & ~TRIANGLE_MARKS) == ray->own;
    uint bits = lane_bits(owned && !open && !own && t >= 0.0f && t <= ray->limit);
    for (; bits != 0; bits &= bits - 1) {
        const uint place = lowest_bit(bits);
        const uint mark = ((const uint *)&id)[place] & ~TRIANGLE_MARKS;
        add_crossing(crossings, (HitData){((const float *)&t)[place], mark});
    }
}

static inline void cross_tree(const CrossingRay *ray, Crossings *crossings)
{
    WideStack stack;
    uint child = 0;
    stack.count = 0;
    do {
        if ((child & WIDE_LEAF) != 0) {
            cross_block(ray, child & ~WIDE_LEAF, crossings);
            continue;
        }
        float8 entry;
        global const BvhWide *node = &ray->search.tracer->nodes[child];
        const int8 met = children_hit(node, &ray->search, &ray->planes, 0, ray->limit, &entry);
        push_children(&stack, entry, met, vload8(0, node->child));
    } while (pop_child(&stack, ray->limit, &child));
}

static NOT_INLINE void cross_triangles(const Tracer *tracer, const Ray *along, float limit,
                                       Crossings *crossings)
{
    CrossingRay ray;
    ray.search = search_along(tracer, along, limit);
    ray.planes = near_planes(&ray.search.slabs.inverse);
    ray.lane = lane_ray(&ray.search, 0);
    ray.limit = limit;
    ray.own = lane_uint(&along->own, 0);
    if (CLRT_BVH && tracer->frame->uses_bvh)
        cross_tree(&ray, crossings);
    else
        for (uint number = 0; number * WIDE < tracer->frame->triangle_count; number++)
            cross_block(&ray, number, crossings);
}
#else
static inline void cross_range(const Search *search, uint2 range, Crossings *crossings)
{
    for (uint index = range.x; index < range.x + range.y; index++) {
        global const TriangleData *triangle = &search->tracer->triangles[index];
        const Corners relative = {corner_relative(triangle->a, search),
                                  corner_relative(triangle->b, search),
                                  corner_relative(triangle->c, search)};
        const Corners sheared = corners_sheared(&relative, &search->shear);
        const Edges edges = edges_of(&sheared);
        if (!edges_own(&sheared, &edges) || triangle->id == search->ray->own)
            continue;
        const Real t = triangle_depth(&sheared, &edges) * search->shear.inverse_z;
        const bool front = edges_face(&edges, &search->shear);
        const bool inner = front == ((triangle->material & TRIANGLE_REVERSED) != 0);
        const bool open = (triangle->material & TRIANGLE_TWO_SIDED) == 0 && inner;
        if (!open && t >= 0.0f && t <= search->limit)
            add_crossing(crossings, (HitData){(float)t, triangle->id});
    }
}

static NOT_INLINE void cross_triangles(const Tracer *tracer, const Ray *along, Real limit,
                                       Crossings *crossings)
{
    const Search search = search_along(tracer, along, limit);
    if (!CLRT_BVH || !tracer->frame->uses_bvh) {
        cross_range(&search, (uint2)(0, tracer->frame->triangle_count), crossings);
        return;
    }
    PairStack stack;
    PairPlace place = {0};
    for (;;) {
        if (place.count > 0)
            cross_range(&search, (uint2)(place.first, place.count), crossings);
        else if (descend(&search, limit, &stack, &place))
            continue;
        if (!pop_place(tracer->nodes, limit, &stack, &place))
            return;
    }
}
#endif

// Stores the number of crossings of each ray in `counts`. Stores the nearest `room` crossings of
// each ray in `hits`, which has `room` entries for each ray. Unused entries get the id NOTHING.
kernel void find_crossings(TRACER_ARGUMENTS, global const RayData *rays, uint count, uint room,
                           global HitData *hits, global uint *counts)
{
    const uint place = (uint)get_global_id(0);
    if (place >= count)
        return;
    Tally tally = {0};
    const Tracer tracer = TRACER(&tally);
    global const RayData *data = &rays[place];
    const Ray ray = {load3(data->origin), load3(data->direction), data->own, NOTHING,
                     RAY_CAMERA,          lanes_of(ALL_LANES)};
    Crossings crossings = {hits + (size_t)place * room, room, 0};
    if (CLRT_TRIANGLES && frame.triangle_count != 0 && data->limit >= 0.0f &&
        any_lane(is_searchable(&ray)))
        cross_triangles(&tracer, &ray, data->limit, &crossings);
    for (uint i = crossings.count; i < room; i++)
        crossings.nearest[i] = (HitData){INFINITY, NOTHING};
    counts[place] = crossings.count;
}
