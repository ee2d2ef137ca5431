// SPDX-License-Identifier: MIT
// One ray through the tree of wide nodes: all children of a node and all triangles of a block are
// tested at once, a lane each (Wald, Benthin and Boulos, "Getting rid of packets", 2008).  Culling
// is pair.cl's, and acceptance triangle.cl's, so the answer is too.
#ifndef CLRT_WIDE_CL
#define CLRT_WIDE_CL
#include "ray.cl"

#if CLRT_WIDE_NODES

// A level of the tree leaves at most WIDE - 1 children waiting.  Storing a node's children writes
// up to WIDE entries past the last.
#define WIDE_STACK_SIZE (BVH_MAX_DEPTH * (WIDE - 1) + 2 * WIDE)

// The rays of the lanes as the searches want them.
typedef struct {
    const Ray *ray;
    ShearAxes axes;
    Shear shear;
    Real3 inverse, near_offset, far_offset; // of the slabs, as in pair.cl
} Search;

// One of them as scalars; arrays of three are by axis.
typedef struct {
    uint axes[3]; // of the shear: its x, y and z
    float origin[3];
    float shear_x, shear_y, inverse_z, direction_z;
    float inverse[3], near_offset[3], far_offset[3];
    uint negative[3]; // which plane of the axis the ray meets first
    float surface[3];
    uint own;
    RayKind kind;
} SingleRay;

typedef struct {
    float t;
    uint id, index;
} SingleHit;

// Children that wait: the distance at which they are entered in the high half, as the bits of a
// float that is not negative, which order as integers do, and which child in the low one.
typedef struct {
    ulong child[WIDE_STACK_SIZE];
    uint count;
} WideWaiting;

static inline float waiting_entry(ulong child)
{
    return as_float((uint)(child >> 32));
}

static inline uint lowest_bit(uint bits)
{
    return popcount((bits & -bits) - 1);
}

// Puts a child on the stack below those of the same node, from `start` on, that are nearer.
static inline void wait_in_order(WideWaiting *waiting, uint start, ulong child)
{
    uint place = waiting->count++;
    for (; place > start && waiting->child[place - 1] < child; place--)
        waiting->child[place] = waiting->child[place - 1];
    waiting->child[place] = child;
}

// Puts the children whose bits are set on the stack, the nearest on top.
static inline void wait_for_children(WideWaiting *waiting, uint bits, const float8 *entry,
                                     uint first)
{
    const float *entries = (const float *)entry;
    const uint start = waiting->count;
    for (; bits != 0; bits &= bits - 1) {
        const uint number = lowest_bit(bits);
        wait_in_order(waiting, start, (ulong)as_uint(entries[number]) << 32 | (first + number));
    }
}

static inline float8 wide_planes(global const BvhWide *node, uint axis, uint side,
                                 const SingleRay *ray, const float *offset)
{
    return fma(vload8(0, node->planes[axis][side]), (float8)(ray->inverse[axis]),
               (float8)(offset[axis]));
}

// The children whose boxes the ray is in before `reach`, and where it enters them.
static inline int8 children_met(global const BvhWide *node, const SingleRay *ray, float reach,
                                float8 *entry)
{
    const uint x = ray->negative[0], y = ray->negative[1], z = ray->negative[2];
    const float8 near_x = wide_planes(node, 0, x, ray, ray->near_offset);
    const float8 near_y = wide_planes(node, 1, y, ray, ray->near_offset);
    const float8 near_z = wide_planes(node, 2, z, ray, ray->near_offset);
    const float8 far_x = wide_planes(node, 0, 1 - x, ray, ray->far_offset);
    const float8 far_y = wide_planes(node, 1, 1 - y, ray, ray->far_offset);
    const float8 far_z = wide_planes(node, 2, 1 - z, ray, ray->far_offset);
    *entry = max(max(near_x, near_y), max(near_z, (float8)(0.0f)));
    return *entry <= min(min(far_x, far_y), min(far_z, (float8)(reach)));
}

static inline float8 block_row(global const TriangleBlock *block, uint corner, uint axis)
{
    return vload8(0, block->corners[corner][axis]);
}

static inline Wide3 block_corner_relative(global const TriangleBlock *block, uint corner,
                                          const uint *axes, const float *origin)
{
    return (Wide3){block_row(block, corner, axes[0]) - origin[axes[0]],
                   block_row(block, corner, axes[1]) - origin[axes[1]],
                   block_row(block, corner, axes[2]) - origin[axes[2]]};
}

static inline Wide3 block_corner(global const TriangleBlock *block, uint corner)
{
    return (Wide3){block_row(block, corner, 0), block_row(block, corner, 1),
                   block_row(block, corner, 2)};
}

// The distances of the triangles whose edges contain the ray, INFINITY where they do not stop it.
static inline float8 block_distances(global const TriangleBlock *block, const SingleRay *ray,
                                     const WideShear *shear, const WideCorners *sheared,
                                     const WideEdges *edges, int8 inside, float reach)
{
    const bool is_shadow = ray->kind == RAY_SHADOW;
    const uint8 id = vload8(0, block->id);
    const int8 front = edges_face(edges, shear);
    const int8 one_sided = (id & TRIANGLE_TWO_SIDED) == 0;
    const int8 open = one_sided && (is_shadow ? front : !front);
    const int8 closed = !open && (id & ~TRIANGLE_TWO_SIDED) != ray->own;
    const float8 t = triangle_depth(sheared, edges) * shear->inverse_z;
    if (ray->kind == RAY_CAMERA)
        return closed && t > 0.0f ? t : INFINITY;
    if (lane_bits(inside && closed && t <= reach) == 0)
        return INFINITY;
    const float8 error = triangle_depth_error(sheared) * fabs(shear->inverse_z);
    const WideCorners corners = {block_corner(block, 0), block_corner(block, 1),
                                 block_corner(block, 2)};
    const Wide3 point = {ray->surface[0], ray->surface[1], ray->surface[2]};
    const WideSurfaceRay surface = {point, front, is_shadow};
    return closed ? surface_ray_distance(&corners, &surface, t, error) : INFINITY;
}

// Tests the triangles of a block against the ray.
static inline __attribute__((always_inline)) void test_block(global const TriangleBlock *blocks,
                                                             uint number, const SingleRay *ray,
                                                             SingleHit *best)
{
    global const TriangleBlock *block = blocks + number;
    const WideShear shear = {ray->shear_x, ray->shear_y, ray->inverse_z, ray->direction_z};
    const WideCorners relative = {block_corner_relative(block, 0, ray->axes, ray->origin),
                                  block_corner_relative(block, 1, ray->axes, ray->origin),
                                  block_corner_relative(block, 2, ray->axes, ray->origin)};
    const WideCorners sheared = corners_sheared(&relative, &shear);
    const WideEdges edges = edges_of(&sheared);
    const int8 inside = edges_contain(&edges);
    if (lane_bits(inside) == 0)
        return;
    const float8 t = block_distances(block, ray, &shear, &sheared, &edges, inside, best->t);
    uint candidates = lane_bits(inside && t <= best->t && t < INFINITY);
    for (; candidates != 0; candidates &= candidates - 1) {
        const uint place = popcount((candidates & -candidates) - 1);
        const float distance = ((const float *)&t)[place];
        const uint id = block->id[place] & ~TRIANGLE_TWO_SIDED;
        if (distance < best->t || (distance == best->t && id < best->id))
            *best = (SingleHit){distance, id, number * WIDE + place};
    }
}

// Enters the nearest of the children whose bits are set; the others wait.
static inline uint enter_children(WideWaiting *waiting, const uint8 *children, uint bits,
                                  const float8 *entry)
{
    const float *entries = (const float *)entry;
    const uint *names = (const uint *)children;
    uint number = lowest_bit(bits);
    uint child = names[number];
    bits &= bits - 1;
    if (bits == 0)
        return child;
    ulong nearest = (ulong)as_uint(entries[number]) << 32 | child;
    const uint start = waiting->count;
    for (; bits != 0; bits &= bits - 1) {
        number = lowest_bit(bits);
        const ulong other = (ulong)as_uint(entries[number]) << 32 | names[number];
        wait_in_order(waiting, start, max(nearest, other));
        nearest = min(nearest, other);
    }
    return (uint)nearest;
}

static inline bool next_child(WideWaiting *waiting, float reach, uint *child)
{
    while (waiting->count > 0) {
        const ulong next = waiting->child[--waiting->count];
        *child = (uint)next;
        if (!(waiting_entry(next) > reach))
            return true;
    }
    return false;
}

static inline Real slab_direction(Real direction, Real smallest)
{
    return fabs(direction) < smallest ? copysign(smallest, direction) : direction;
}

static inline void search_slab(Real direction, Real origin, Real slack, Real *inverse,
                               Real *near_offset, Real *far_offset)
{
    const Real widening = copysign(slack, direction);
    *inverse = 1.0f / direction;
    *near_offset = -(origin + widening) * *inverse;
    *far_offset = -(origin - widening) * *inverse;
}

// Prepares the rays for directions d and origins o, which are the ray's own in its active lanes.
static inline void search_prepare(Search *search, const Ray *ray, Real3 o, Real3 d)
{
    const Real smallest = 0x1p-30f * largest_component(d);
    const Real slack = BVH_SLACK * largest_component(o);
    search->ray = ray;
    search->axes = shear_axes(d);
    search->shear = shear_along(d, &search->axes);
    search_slab(slab_direction(d.x, smallest), o.x, slack, &search->inverse.x,
                &search->near_offset.x, &search->far_offset.x);
    search_slab(slab_direction(d.y, smallest), o.y, slack, &search->inverse.y,
                &search->near_offset.y, &search->far_offset.y);
    search_slab(slab_direction(d.z, smallest), o.z, slack, &search->inverse.z,
                &search->near_offset.z, &search->far_offset.z);
}

static inline float real_of(const Real *lanes, uint lane)
{
    return ((const float *)lanes)[lane];
}

static inline uint count_of(const Count *lanes, uint lane)
{
    return ((const uint *)lanes)[lane];
}

static inline void copy3(float *to, const Real3 *from, uint lane)
{
    to[0] = real_of(&from->x, lane);
    to[1] = real_of(&from->y, lane);
    to[2] = real_of(&from->z, lane);
}

static inline SingleRay single_ray(const Search *search, uint lane)
{
    SingleRay single = {.axes = {count_of(&search->axes.x, lane), count_of(&search->axes.y, lane),
                                 count_of(&search->axes.z, lane)},
                        .shear_x = real_of(&search->shear.shear_x, lane),
                        .shear_y = real_of(&search->shear.shear_y, lane),
                        .inverse_z = real_of(&search->shear.inverse_z, lane),
                        .direction_z = real_of(&search->shear.direction_z, lane),
                        .own = count_of(&search->ray->own, lane),
                        .kind = search->ray->kind};
    copy3(single.origin, &search->ray->origin, lane);
    copy3(single.inverse, &search->inverse, lane);
    copy3(single.near_offset, &search->near_offset, lane);
    copy3(single.far_offset, &search->far_offset, lane);
    copy3(single.surface, &search->ray->surface, lane);
    for (uint axis = 0; axis < 3; axis++)
        single.negative[axis] = single.inverse[axis] < 0.0f;
    return single;
}

// Asks for memory that is going to be read.
static inline void fetch_ahead(global const void *start, uint bytes)
{
#if defined(__x86_64__) && __has_builtin(__builtin_prefetch)
    for (uint byte = 0; byte < bytes; byte += 64)
        __builtin_prefetch((const void *)((ulong)start + byte));
#else
    (void)start, (void)bytes;
#endif
}

static inline void fetch_child_ahead(const SceneView *scene, uint child)
{
    if ((child & WIDE_LEAF) == 0)
        fetch_ahead(scene->nodes + child, sizeof(BvhWide));
    else
        fetch_ahead(scene->triangles + (child & ~WIDE_LEAF), sizeof(TriangleBlock));
}

// Rays that search side by side, a ray in each lane.
typedef struct {
    SingleRay rays[CLRT_LANES];
    SingleHit hits[CLRT_LANES];
    uint child[CLRT_LANES]; // where each goes next
    uint inner, leaves;     // bits of the lanes that go to a node, and to a block
    WideWaiting waiting[CLRT_LANES];
} Walkers;

static inline void walk_to(Walkers *walkers, const SceneView *scene, uint lane, uint child)
{
    fetch_child_ahead(scene, child);
    walkers->child[lane] = child;
    if (child & WIDE_LEAF)
        walkers->leaves |= 1u << lane;
    else
        walkers->inner |= 1u << lane;
}

static inline void walk_on(Walkers *walkers, const SceneView *scene, uint lane)
{
    uint child;
    if (next_child(&walkers->waiting[lane], walkers->hits[lane].t, &child))
        walk_to(walkers, scene, lane, child);
}

static inline void walk_nodes(Walkers *walkers, const SceneView *scene, Tally *tally)
{
    uint bits = walkers->inner;
    walkers->inner = 0;
    for (; bits != 0; bits &= bits - 1) {
        const uint lane = lowest_bit(bits);
        global const BvhWide *node = &scene->nodes[walkers->child[lane]];
        const uint8 children = vload8(0, node->child);
        float8 entry;
        const uint met =
            lane_bits(children_met(node, &walkers->rays[lane], walkers->hits[lane].t, &entry));
        if (CLRT_STATISTICS)
            tally->box_tests += node->child_count;
        if (met == 0)
            walk_on(walkers, scene, lane);
        else
            walk_to(walkers, scene, lane,
                    enter_children(&walkers->waiting[lane], &children, met, &entry));
    }
}

static inline void walk_leaves(Walkers *walkers, const SceneView *scene, Tally *tally)
{
    uint bits = walkers->leaves;
    walkers->leaves = 0;
    for (; bits != 0; bits &= bits - 1) {
        const uint lane = lowest_bit(bits);
        SingleHit *hit = &walkers->hits[lane];
        test_block(scene->triangles, walkers->child[lane] & ~WIDE_LEAF, &walkers->rays[lane], hit);
        if (CLRT_STATISTICS)
            tally->triangle_tests += WIDE;
        if (walkers->rays[lane].kind != RAY_SHADOW || hit->id == NOTHING)
            walk_on(walkers, scene, lane);
    }
}

// Searches for the rays of the lanes whose bits are set, side by side: while one waits for memory
// or for the result of its last step, the others go on.
static __attribute__((noinline)) void meet_alone(const SceneView *scene, const Search *search,
                                                 uint bits, Hit *best, Tally *tally)
{
    float *t = (float *)&best->t;
    uint *id = (uint *)&best->id, *index = (uint *)&best->index;
    Walkers walkers;
    walkers.inner = bits;
    walkers.leaves = 0;
    for (uint left = bits; left != 0; left &= left - 1) {
        const uint lane = lowest_bit(left);
        walkers.rays[lane] = single_ray(search, lane);
        walkers.hits[lane] = (SingleHit){t[lane], id[lane], index[lane]};
        walkers.child[lane] = 0;
        walkers.waiting[lane].count = 0;
    }
    while ((walkers.inner | walkers.leaves) != 0) {
        while (walkers.inner != 0)
            walk_nodes(&walkers, scene, tally);
        walk_leaves(&walkers, scene, tally);
    }
    for (uint left = bits; left != 0; left &= left - 1) {
        const uint lane = lowest_bit(left);
        t[lane] = walkers.hits[lane].t;
        id[lane] = walkers.hits[lane].id;
        index[lane] = walkers.hits[lane].index;
    }
}

#endif
#endif
