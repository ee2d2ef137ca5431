// SPDX-License-Identifier: MIT
// Traces single rays through trees of wide nodes. Vector operations test all children of a node, or
// all triangles or spheres of a block, at once (Wald, Benthin and Boulos, "Getting rid of packets",
// 2008). The rays of a packet's lanes take turns, one step each: while one ray waits for memory,
// the others advance.
//
// Invariant: boxes are culled as in pair.cl, and accept.cl accepts hits, so both searches find the
// same hits.
#ifndef CLRT_WIDE_CL
#define CLRT_WIDE_CL
#include "accept.cl"
#include "sphere_blocks.cl"

#if CLRT_WIDE_NODES

// Returns search_reach for one lane.
static inline float lane_reach(const Search *search, const Hit *hits, uint lane)
{
    return lane_real(&hits->t, lane) + lane_real(&search->tie, lane);
}

// For each axis and lane, an index into BvhWide::planes: the row of the planes by which the lane's
// ray enters boxes. The row of the opposite planes is at index ^ OTHER_PLANES.
typedef struct {
    uint rows[3][CLRT_LANES];
} NearPlanes;

#define OTHER_PLANES WIDE

static inline NearPlanes near_planes(const Real3 *inverse)
{
    NearPlanes planes;
    FOR_LANES(vstore)(WIDE * sign_bit(inverse->x), 0, planes.rows[0]);
    FOR_LANES(vstore)(WIDE * (2 + sign_bit(inverse->y)), 0, planes.rows[1]);
    FOR_LANES(vstore)(WIDE * (4 + sign_bit(inverse->z)), 0, planes.rows[2]);
    return planes;
}

static inline float8 plane_distances(global const float *planes, const Real *inverse,
                                     const Real *offset, uint lane)
{
    return fma(vload8(0, planes), (float8)(lane_real(inverse, lane)),
               (float8)(lane_real(offset, lane)));
}

// Returns the children whose boxes the lane's ray enters before `reach`. *entry receives the
// distances at which the ray enters the boxes.
static inline int8 children_hit(global const BvhWide *node, const Search *search,
                                const NearPlanes *planes, uint lane, float reach, float8 *entry)
{
    global const float *rows = node->planes[0][0];
    const uint x = planes->rows[0][lane], y = planes->rows[1][lane], z = planes->rows[2][lane];
    const Real3 *inverse = &search->slabs.inverse;
    const Real3 *near = &search->slabs.near_offset, *far = &search->slabs.far_offset;
    const Wide3 entries = {plane_distances(rows + x, &inverse->x, &near->x, lane),
                           plane_distances(rows + y, &inverse->y, &near->y, lane),
                           plane_distances(rows + z, &inverse->z, &near->z, lane)};
    const Wide3 exits = {plane_distances(rows + (x ^ OTHER_PLANES), &inverse->x, &far->x, lane),
                         plane_distances(rows + (y ^ OTHER_PLANES), &inverse->y, &far->y, lane),
                         plane_distances(rows + (z ^ OTHER_PLANES), &inverse->z, &far->z, lane)};
    *entry = entry_distance(entries);
    return *entry <= leaving_distance(exits, (float8)(reach));
}

static inline float8 block_row(global const TriangleBlock *block, uint corner, uint axis)
{
    return vload8(0, block->corners[corner][axis]);
}

static inline Wide3 block_corner(global const TriangleBlock *block, uint corner)
{
    return (Wide3){block_row(block, corner, 0), block_row(block, corner, 1),
                   block_row(block, corner, 2)};
}

// A lane's ray, prepared for testing a block.
typedef struct {
    uint axes[3];      // of the shear: its x, y and z
    float backward[3]; // minus the origin, in the order of these axes
    WideShear shear;
} LaneRay;

static inline LaneRay lane_ray(const Search *search, uint lane)
{
    return (LaneRay){
        {lane_uint(&search->axes.x, lane), lane_uint(&search->axes.y, lane),
         lane_uint(&search->axes.z, lane)},
        {lane_real(&search->backward.x, lane), lane_real(&search->backward.y, lane),
         lane_real(&search->backward.z, lane)},
        {lane_real(&search->shear.shear_x, lane), lane_real(&search->shear.shear_y, lane),
         lane_real(&search->shear.inverse_z, lane), lane_real(&search->shear.direction_z, lane)}};
}

static inline Wide3 block_corner_relative(global const TriangleBlock *block, uint corner,
                                          const LaneRay *ray)
{
    return (Wide3){block_row(block, corner, ray->axes[0]) + ray->backward[0],
                   block_row(block, corner, ray->axes[1]) + ray->backward[1],
                   block_row(block, corner, ray->axes[2]) + ray->backward[2]};
}

// A triangle's position. `index` counts the slots of all blocks.
typedef struct {
    global const TriangleBlock *block;
    uint place, index;
} BlockPlace;

static inline BlockPlace block_start(const Tracer *tracer, uint number)
{
    return (BlockPlace){tracer->triangles + number, 0, number * WIDE};
}

static inline Wide3 splat3(const Real3 *v, uint lane)
{
    return (Wide3){lane_real(&v->x, lane), lane_real(&v->y, lane), lane_real(&v->z, lane)};
}

// Returns the triangles that stop the lane's ray. The ray's line must hit each triangle in
// `triangles` so close to the ray's start that rounding could put the hit before or behind the
// start.
static NOT_INLINE int8 block_neighbors(const Search *search, uint lane, uint first, uint triangles,
                                       uint from_back)
{
    int8 stops = 0;
    for (; triangles != 0; triangles &= triangles - 1) {
        const uint place = lowest_bit(triangles);
        const Mask back = lanes_of((from_back >> place & 1) << lane);
        const Mask stop = stops_on_neighbor(search, (UInt)(first + place), back);
        ((int *)&stops)[place] = (lane_bits(stop) >> lane & 1) != 0 ? -1 : 0;
    }
    return stops;
}

// Returns the distances at which a lane's ray stops on the triangles of a block, as stop_distances
// (accept.cl) does for one triangle.
static inline float8 block_distances(const BlockPlace *start, const Search *search, uint lane,
                                     const WideTriangleTest *test, float reach)
{
    global const TriangleBlock *block = start->block;
    const Ray *ray = search->ray;
    const bool from_eye = plain_kind(ray->kind) == RAY_CAMERA;
    const WideMeeting met = triangle_meeting(test, vload8(0, block->id), reach, from_eye);
    if (lane_bits(met.near) == 0)
        return met.clear;
    const WideCorners corners = {block_corner(block, 0), block_corner(block, 1),
                                 block_corner(block, 2)};
    const Real behind = search_behind(search);
    const WideSurfaceRay surface = {splat3(&ray->origin, lane), met.front,          met.inner,
                                    lane_real(&behind, lane),   length_of_ray(ray), blur_of(ray)};
    const float8 error = triangle_depth_error(&test->sheared) * fabs(test->shear.inverse_z);
    int8 in_doubt, stops = 0;
    const float8 distance = surface_ray_distance(&corners, &surface, met.t, error, &in_doubt);
    in_doubt = in_doubt && met.near && !from_eye;
    if (lane_bits(in_doubt) != 0)
        stops =
            block_neighbors(search, lane, start->index, lane_bits(in_doubt), lane_bits(!met.front));
    const float8 near = stops ? max(met.t, 0.0f) : distance;
    return met.near ? near : met.clear;
}

// Tests a block's triangles against the lane's ray. Returns whether the ray's hit changed.
static ALWAYS_INLINE bool intersect_block(const BlockPlace *start, const Search *search, uint lane,
                                          Hit *hits)
{
    global const TriangleBlock *block = start->block;
    const LaneRay ray = lane_ray(search, lane);
    const WideCorners relative = {block_corner_relative(block, 0, &ray),
                                  block_corner_relative(block, 1, &ray),
                                  block_corner_relative(block, 2, &ray)};
    WideTriangleTest test = triangle_test(&relative, &ray.shear);
    const uint8 ids = vload8(0, block->id) & ~TRIANGLE_MARKS;
    test.inside = test.inside && ids != lane_uint(&search->ray->own, lane);
    if (lane_bits(test.inside) == 0)
        return false;
    const float reach = lane_reach(search, hits, lane);
    const float8 distances = block_distances(start, search, lane, &test, reach);
    uint candidates = lane_bits(distances <= reach && distances < INFINITY);
    bool changed = false;
    for (; candidates != 0; candidates &= candidates - 1) {
        const uint place = lowest_bit(candidates);
        Hit triangle = {((const float *)&distances)[place], ((const uint *)&ids)[place],
                        start->index + place};
        const Mask accepted = accept_triangle(search, lanes_of(1u << lane), &triangle, hits);
        changed |= any_lane(accepted);
    }
    return changed;
}

static inline bool has_spheres(uint leaf)
{
    return CLRT_SPHERES && leaf >= WIDE_SPHERES;
}

// Returns whether nodes and blocks probably exceed a cache of 1 MB. Only then do searches prefetch,
// because prefetching makes smaller scenes 7 % slower.
static inline bool exceeds_cache(const Tracer *tracer)
{
    return tracer->frame->triangle_count >= 30000;
}

// Prefetches a node, or most of a block: four cache lines. OpenCL's prefetch does nothing on PoCL.
static inline void prefetch_child(const Tracer *tracer, uint child)
{
#if defined(__x86_64__) && __has_builtin(__builtin_prefetch)
    const ulong node = (ulong)(tracer->nodes + child);
    const ulong triangles = (ulong)(tracer->triangles + (child & ~WIDE_LEAF));
    const ulong block = has_spheres(child) ? (ulong)sphere_block(tracer, child) : triangles;
    const ulong start = (child & WIDE_LEAF) != 0 ? block : node;
    __builtin_prefetch((const void *)start);
    __builtin_prefetch((const void *)(start + 64));
    __builtin_prefetch((const void *)(start + 128));
    __builtin_prefetch((const void *)(start + 192));
#else
    (void)tracer, (void)child;
#endif
}

// Rays that search side by side, one per lane.
typedef struct {
    const Search *search;
    Hit *hits;
    SpherePairs *pairs; // of the packets, if the tree has spheres
    NearPlanes near_planes;
    uint child[CLRT_LANES]; // the next child of each ray
    uint leaves, ended;     // bits of the lanes at a block, and of the lanes whose search has ended
    bool prefetches;
    WideStack stack[CLRT_LANES];
} LaneSearches;

// Moves a lane's search to its next child, or ends it. With AVX2, inlining both calls of this
// function saves 2 to 5 % of the time of meshes, and 4 % of the time of 10,000 balls.
static ALWAYS_INLINE void advance_lane(LaneSearches *searches, uint lane)
{
    uint child;
    const uint bit = 1u << lane;
    const float reach = lane_reach(searches->search, searches->hits, lane);
    if (!pop_child(&searches->stack[lane], reach, &child)) {
        searches->ended |= bit;
        return;
    }
    if (searches->prefetches)
        prefetch_child(searches->search->tracer, child);
    searches->child[lane] = child;
    searches->leaves |= (child & WIDE_LEAF) != 0 ? bit : 0;
}

// Advances each lane that is at a node by one step.
static inline void visit_nodes(LaneSearches *searches)
{
    const Tracer *tracer = searches->search->tracer;
    uint bits = ALL_LANES & ~(searches->leaves | searches->ended);
    for (; bits != 0; bits &= bits - 1) {
        const uint lane = lowest_bit(bits);
        global const BvhWide *node = &tracer->nodes[searches->child[lane]];
        // The children are read while the node's other cache lines are loading.
        const uint8 children = vload8(0, node->child);
        const float reach = lane_reach(searches->search, searches->hits, lane);
        float8 entry;
        const int8 met =
            children_hit(node, searches->search, &searches->near_planes, lane, reach, &entry);
        if (CLRT_STATISTICS)
            tracer->tally->box_tests += node->child_count;
        push_children(&searches->stack[lane], entry, met, children);
        advance_lane(searches, lane);
    }
}

// Pairs the given lanes with their blocks, which must be blocks of spheres. Returns the lanes whose
// hits changed, or whose `t` limit_ray lowered.
static NOT_INLINE uint visit_spheres(LaneSearches *searches, uint bits)
{
    SpherePairs *pairs = searches->pairs;
    const uint packet = (uint)(searches->hits - pairs->hits);
    pairs->changed[packet] = 0;
    for (; bits != 0; bits &= bits - 1)
        pair_ray(pairs, packet, lowest_bit(bits), searches->child[lowest_bit(bits)]);
    return pairs->changed[packet];
}

// Tests the block's triangles against the lane's ray. Returns whether the ray's hit changed.
static inline bool visit_triangles(const Search *search, uint lane, uint child, Hit *hits)
{
    const BlockPlace start = block_start(search->tracer, child & ~WIDE_LEAF);
    if (CLRT_STATISTICS)
        search->tracer->tally->triangle_tests += WIDE;
    return intersect_block(&start, search, lane, hits);
}

// Tests the next block of each lane whose next child is a block. A lane then advances, unless a new
// hit ends its search. All lanes search the same tree.
static inline void visit_leaves(LaneSearches *searches)
{
    const bool any_hit = ends_at_any_hit(searches->search->ray->kind);
    uint bits = searches->leaves, changed = 0;
    const bool spheres = bits != 0 && has_spheres(searches->child[lowest_bit(bits)]);
    searches->leaves = 0;
    if (spheres)
        changed = visit_spheres(searches, bits);
    for (; bits != 0; bits &= bits - 1) {
        const uint lane = lowest_bit(bits);
        if (!spheres &&
            visit_triangles(searches->search, lane, searches->child[lane], searches->hits))
            changed |= 1u << lane;
        if (!any_hit || (changed >> lane & 1) == 0)
            advance_lane(searches, lane);
        else
            searches->ended |= 1u << lane;
    }
}

// Searches the subtree `child` with the rays of the lanes whose bits are set. This is a fifth
// faster than tracing one ray after another. If the subtree has spheres, `pairs` must have been
// started for an array of hits that contains *best.
static NOT_INLINE void intersect_lanes(const Search *search, uint bits, uint child, Hit *best,
                                       SpherePairs *pairs)
{
    LaneSearches searches;
    searches.search = search;
    searches.hits = best;
    searches.pairs = pairs;
    searches.near_planes = near_planes(&search->slabs.inverse);
    searches.ended = ALL_LANES & ~bits;
    searches.prefetches = exceeds_cache(search->tracer);
    searches.leaves = 0;
    for (; bits != 0; bits &= bits - 1) {
        const uint lane = lowest_bit(bits);
        searches.child[lane] = child;
        searches.stack[lane].count = 0;
    }
    while (searches.ended != ALL_LANES) {
        visit_nodes(&searches);
        visit_leaves(&searches);
    }
}

#endif
#endif
