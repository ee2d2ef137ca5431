// SPDX-License-Identifier: MIT
// Traces single rays through the tree of wide nodes. All children of a node and all triangles of a
// block are tested at once (Wald, Benthin and Boulos, "Getting rid of packets", 2008). The rays of
// a packet's lanes advance alternately, one step each. Boxes are culled as in pair.cl, and
// triangle.inc.cl accepts hits, so both searches find the same hits.
#ifndef CLRT_WIDE_CL
#define CLRT_WIDE_CL
#include "order.cl"
#include "wide_stack.cl"

#if CLRT_WIDE_NODES

static inline float lane_real(const Real *lanes, uint lane)
{
    return ((const float *)lanes)[lane];
}

static inline uint lane_uint(const UInt *lanes, uint lane)
{
    return ((const uint *)lanes)[lane];
}

// search_reach for one lane.
static inline float lane_reach(const Search *search, const Hit *hits, uint lane)
{
    return lane_real(&hits->t, lane) + lane_real(&search->tie, lane);
}

// The planes by which rays enter boxes: for each axis and lane, the place of a row of
// BvhWide::planes. place ^ OTHER_PLANES is the row of the opposite planes.
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

// Returns the children whose boxes the lane's ray enters before `reach`. Stores the distances at
// which the ray enters in *entry.
static inline int8 children_hit(global const BvhWide *node, const Search *search,
                                const NearPlanes *planes, uint lane, float reach, float8 *entry)
{
    global const float *rows = node->planes[0][0];
    const uint x = planes->rows[0][lane], y = planes->rows[1][lane], z = planes->rows[2][lane];
    const Real3 *inverse = &search->slabs.inverse;
    const Real3 *near = &search->slabs.near_offset, *far = &search->slabs.far_offset;
    const float8 near_x = plane_distances(rows + x, &inverse->x, &near->x, lane);
    const float8 near_y = plane_distances(rows + y, &inverse->y, &near->y, lane);
    const float8 near_z = plane_distances(rows + z, &inverse->z, &near->z, lane);
    const float8 far_x = plane_distances(rows + (x ^ OTHER_PLANES), &inverse->x, &far->x, lane);
    const float8 far_y = plane_distances(rows + (y ^ OTHER_PLANES), &inverse->y, &far->y, lane);
    const float8 far_z = plane_distances(rows + (z ^ OTHER_PLANES), &inverse->z, &far->z, lane);
    *entry = max(max(near_x, near_y), max(near_z, (float8)(0.0f)));
    return *entry <= min(min(far_x, far_y), min(far_z, (float8)(reach)));
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
    uint axes[3];    // of the shear: its x, y and z
    float origin[3]; // in the order of these axes
    WideShear shear;
} LaneRay;

static inline LaneRay lane_ray(const Search *search, uint lane)
{
    return (LaneRay){
        {lane_uint(&search->axes.x, lane), lane_uint(&search->axes.y, lane),
         lane_uint(&search->axes.z, lane)},
        {lane_real(&search->origin.x, lane), lane_real(&search->origin.y, lane),
         lane_real(&search->origin.z, lane)},
        {lane_real(&search->shear.shear_x, lane), lane_real(&search->shear.shear_y, lane),
         lane_real(&search->shear.inverse_z, lane), lane_real(&search->shear.direction_z, lane)}};
}

static inline Wide3 block_corner_relative(global const TriangleBlock *block, uint corner,
                                          const LaneRay *ray)
{
    return (Wide3){block_row(block, corner, ray->axes[0]) - ray->origin[0],
                   block_row(block, corner, ray->axes[1]) - ray->origin[1],
                   block_row(block, corner, ray->axes[2]) - ray->origin[2]};
}

// The result of testing a lane's ray against a block. `inside` selects the triangles whose edges
// contain the ray.
typedef struct {
    WideShear shear;
    WideCorners sheared;
    WideEdges edges;
    int8 inside;
} BlockTest;

// A triangle's position. index counts the triangles of all blocks.
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

// Returns which triangles of the block stop the lane's ray, among the triangles that its line hits
// within rounding of its start.
static NOT_INLINE int8 block_neighbors(const WideCorners *corners, const Search *search, uint lane,
                                       uint first, int8 from_back)
{
    const Ray *ray = search->ray;
    if (lane_uint(&ray->own_index, lane) == NOTHING)
        return 0;
    const Corners owns = fetch_corners(search->tracer, (UInt)(lane_uint(&ray->own_index, lane)));
    const WideCorners own = {splat3(&owns.a, 0), splat3(&owns.b, 0), splat3(&owns.c, 0)};
    int8 cross;
    int8 stops = hits_neighbor(&own, corners, splat3(&ray->direction, lane), from_back, &cross);
    for (uint bits = lane_bits(cross); bits != 0; bits &= bits - 1) {
        const uint place = lowest_bit(bits);
        const Mask ahead = is_ahead(search->tracer, ray, (UInt)(first + place));
        ((int *)&stops)[place] = (lane_bits(ahead) >> lane & 1) != 0 ? -1 : 0;
    }
    return stops;
}

// Returns the distances of the triangles that stop the ray, INFINITY for the others. Distances of
// camera rays may be beyond `reach`.
static inline float8 block_distances(const BlockPlace *start, const Search *search, uint lane,
                                     const BlockTest *test, float reach)
{
    global const TriangleBlock *block = start->block;
    const Ray *ray = search->ray;
    const WideShear *shear = &test->shear;
    const uint8 id = vload8(0, block->id);
    const int8 front = edges_face(&test->edges, shear);
    const int8 inner = front == ((id & TRIANGLE_REVERSED) != 0);
    const int8 one_sided = (id & TRIANGLE_TWO_SIDED) == 0;
    const int8 open = one_sided && inner;
    const int8 own = (id & ~TRIANGLE_MARKS) == lane_uint(&ray->own, lane);
    const int8 closed = test->inside && !open && !own;
    if (lane_bits(closed) == 0)
        return INFINITY;
    const float8 t = triangle_depth(&test->sheared, &test->edges) * shear->inverse_z;
    const float8 clear = closed && t > 0.0f ? t : INFINITY;
    int8 near = closed && t <= reach;
    if (ray->kind == RAY_CAMERA)
        near = near && triangle_is_at_origin(t, shear);
    else
        near = near && (t > 0.0f || triangle_is_at_origin(t, shear));
    if (lane_bits(near) == 0)
        return ray->kind == RAY_CAMERA ? clear : INFINITY;
    const float8 error = triangle_depth_error(&test->sheared) * fabs(shear->inverse_z);
    const WideCorners corners = {block_corner(block, 0), block_corner(block, 1),
                                 block_corner(block, 2)};
    const WideSurfaceRay surface = {
        splat3(&ray->origin, lane), front,       inner, lane_real(&search->behind, lane),
        length_of_ray(ray),         blur_of(ray)};
    int8 in_doubt;
    const float8 distance = surface_ray_distance(&corners, &surface, t, error, &in_doubt);
    if (ray->kind == RAY_CAMERA)
        return near ? distance : clear;
    in_doubt = in_doubt && near;
    if (lane_bits(in_doubt) == 0)
        return near ? distance : INFINITY;
    const int8 stops = block_neighbors(&corners, search, lane, start->index, !front);
    return near ? (in_doubt && stops ? max(t, 0.0f) : distance) : INFINITY;
}

// triangle_is_nearer for one lane.
static NOT_INLINE bool lane_triangle_is_nearer(const Search *search, uint lane, uint id, uint index,
                                               const Hit *hits)
{
    const Mask lanes = lanes_of(1u << lane);
    const Mask nearer = triangle_is_nearer(search, (UInt)(id), (UInt)(index), hits, lanes);
    return (lane_bits(nearer) >> lane & 1) != 0;
}

// Records the nearest distance if it precedes the lane's hit, and returns whether it does.
static inline bool update_lane_hit(const float8 *distances, const BlockPlace *start,
                                   const Search *search, uint lane, Hit *hits)
{
    const float tie = lane_real(&search->tie, lane), limit = lane_real(&search->limit, lane);
    float *best_t = (float *)&hits->t + lane;
    uint *best_id = (uint *)&hits->id + lane, *best_index = (uint *)&hits->index + lane;
    uint candidates =
        lane_bits(*distances <= lane_reach(search, hits, lane) && *distances < INFINITY);
    bool changed = false;
    for (; candidates != 0; candidates &= candidates - 1) {
        const uint place = lowest_bit(candidates);
        const float t = ((const float *)distances)[place];
        const uint id = start->block->id[place] & ~TRIANGLE_MARKS;
        bool precedes = t < *best_t || (t == *best_t && id < *best_id);
        if (fabs(t - *best_t) <= tie && t < limit && *best_t < limit)
            precedes = lane_triangle_is_nearer(search, lane, id, start->index + place, hits);
        if (precedes) {
            *best_t = t;
            *best_id = id;
            *best_index = start->index + place;
            changed = true;
        }
    }
    return changed;
}

// Tests a block's triangles against the lane's ray. Returns whether its hit changed.
static ALWAYS_INLINE bool intersect_block(const BlockPlace *start, const Search *search, uint lane,
                                          Hit *hits)
{
    global const TriangleBlock *block = start->block;
    const LaneRay ray = lane_ray(search, lane);
    const WideCorners relative = {block_corner_relative(block, 0, &ray),
                                  block_corner_relative(block, 1, &ray),
                                  block_corner_relative(block, 2, &ray)};
    BlockTest test;
    test.shear = ray.shear;
    test.sheared = corners_sheared(&relative, &ray.shear);
    test.edges = edges_of(&test.sheared);
    test.inside = edges_contain(&test.edges);
    if (lane_bits(test.inside) == 0)
        return false;
    const float reach = lane_reach(search, hits, lane);
    const float8 distances = block_distances(start, search, lane, &test, reach);
    return update_lane_hit(&distances, start, search, lane, hits);
}

// Returns whether the scene probably exceeds the caches. Prefetching makes other scenes 7 % slower.
static inline bool is_dense(const Tracer *tracer)
{
    return tracer->frame->triangle_count >= 300000;
}

// Prefetches a node, or most of a block: four cache lines. OpenCL's prefetch does nothing on PoCL.
static inline void prefetch_child(const Tracer *tracer, uint child)
{
#if defined(__x86_64__) && __has_builtin(__builtin_prefetch)
    const ulong node = (ulong)(tracer->nodes + child);
    const ulong block = (ulong)(tracer->triangles + (child & ~WIDE_LEAF));
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
    NearPlanes near_planes;
    uint child[CLRT_LANES]; // the next child of each ray
    uint leaves, ended;     // bits of the lanes at a block, and of the lanes that have ended
    bool prefetches;
    WideStack stack[CLRT_LANES];
} LaneSearches;

static inline void advance_lane(LaneSearches *searches, uint lane)
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
        // Read early, while the other cache lines of the node are loading.
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

// Advances each lane that is at a block by one step. A shadow ray stops at its first hit.
static inline void visit_leaves(LaneSearches *searches)
{
    const Tracer *tracer = searches->search->tracer;
    const bool is_shadow = searches->search->ray->kind == RAY_SHADOW;
    uint bits = searches->leaves;
    searches->leaves = 0;
    for (; bits != 0; bits &= bits - 1) {
        const uint lane = lowest_bit(bits);
        const BlockPlace start = block_start(tracer, searches->child[lane] & ~WIDE_LEAF);
        const bool changed = intersect_block(&start, searches->search, lane, searches->hits);
        if (CLRT_STATISTICS)
            tracer->tally->triangle_tests += WIDE;
        if (!is_shadow || !changed)
            advance_lane(searches, lane);
        else
            searches->ended |= 1u << lane;
    }
}

// Searches below a child for the rays of the lanes whose bits are set. While one ray waits for
// memory or for its last step's result, the others advance. This is a fifth faster than tracing one
// ray after another.
static NOT_INLINE void intersect_lanes(const Search *search, uint bits, uint child, Hit *best)
{
    LaneSearches searches;
    searches.search = search;
    searches.hits = best;
    searches.near_planes = near_planes(&search->slabs.inverse);
    searches.ended = ALL_LANES & ~bits;
    searches.prefetches = is_dense(search->tracer);
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
