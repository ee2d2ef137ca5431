// SPDX-License-Identifier: MIT
// The plain search, for GPUs and for reading: one ray traverses the binary tree. Boxes only cull,
// and never a triangle that the exact test would accept. The host grows each box by BVH_SLACK
// times its largest coordinate. This file moves the ray's origin away from each plane by BVH_SLACK
// times the origin's largest coordinate. Together they cover the rounding of the triangle test and
// of the slabs (shared.h). The hit is therefore the same for every tree, for every traversal order
// and without a tree.
#ifndef CLRT_PAIR_CL
#define CLRT_PAIR_CL
#include "fetch.cl"

#if !CLRT_WIDE_NODES

// A ray prepared for the triangle and slab tests. The slabs are the constants of six planes:
// distance to a plane = fma(plane, inverse, offset).
typedef struct {
    const SceneView *scene;
    ShearAxes axes;
    Shear shear;
    Real3 origin; // in the order of the axes
    Real3 inverse, near_offset, far_offset;
    uint negative_x, negative_y, negative_z; // which plane of each axis the ray enters by
} Query;

// A zero direction becomes 2^-30 of the largest component. No infinity or NaN can then arise from
// rays whose largest component exceeds 2^-96; shorter ones have no usable direction.
static inline Real slab_direction(Real direction, Real smallest)
{
    return fabs(direction) < smallest ? copysign(smallest, direction) : direction;
}

static inline Query query_of(const SceneView *scene, const Ray *ray)
{
    Query query;
    query.scene = scene;
    query.axes = shear_axes(ray->direction);
    query.shear = shear_along(ray->direction, &query.axes);
    query.origin = axes_ordered(ray->origin, &query.axes);
    const Real smallest = 0x1p-30f * largest_component(ray->direction);
    const Real slack = BVH_SLACK * largest_component(ray->origin);
    const Real x = slab_direction(ray->direction.x, smallest);
    const Real y = slab_direction(ray->direction.y, smallest);
    const Real z = slab_direction(ray->direction.z, smallest);
    const Real3 o = ray->origin, i = {1.0f / x, 1.0f / y, 1.0f / z};
    const Real3 widening = {copysign(slack, x), copysign(slack, y), copysign(slack, z)};
    const Real3 near = sum3(o, widening), far = difference(o, widening);
    query.inverse = i;
    query.near_offset = real3_of(-near.x * i.x, -near.y * i.y, -near.z * i.z);
    query.far_offset = real3_of(-far.x * i.x, -far.y * i.y, -far.z * i.z);
    query.negative_x = x < 0.0f;
    query.negative_y = y < 0.0f;
    query.negative_z = z < 0.0f;
    return query;
}

static inline Real2 plane_distances(global const BvhPair *node, uint2 plane, Real inverse,
                                    Real offset)
{
    global const float *planes = node->planes[plane.x][plane.y];
    return fma((Real2)(planes[0], planes[1]), (Real2)(inverse), (Real2)(offset));
}

// Computes the interval [entry, leave] of the ray inside each child's box. It is empty if the ray
// misses.
static inline void intersect_slabs(global const BvhPair *node, const Query *query, Real reach,
                                   Real2 *entry, Real2 *leave)
{
    const uint x = query->negative_x, y = query->negative_y, z = query->negative_z;
    const Real3 inverse = query->inverse, near = query->near_offset, far = query->far_offset;
    const Real2 near_x = plane_distances(node, (uint2)(0, x), inverse.x, near.x);
    const Real2 near_y = plane_distances(node, (uint2)(1, y), inverse.y, near.y);
    const Real2 near_z = plane_distances(node, (uint2)(2, z), inverse.z, near.z);
    const Real2 far_x = plane_distances(node, (uint2)(0, 1 - x), inverse.x, far.x);
    const Real2 far_y = plane_distances(node, (uint2)(1, 1 - y), inverse.y, far.y);
    const Real2 far_z = plane_distances(node, (uint2)(2, 1 - z), inverse.z, far.z);
    *entry = max(max(near_x, near_y), max(near_z, (Real2)(0.0f)));
    *leave = min(min(far_x, far_y), min(far_z, (Real2)(reach)));
}

// Reading the components by axis makes the permutation free.
static inline Real3 corner_relative(global const float *corner, const Query *query)
{
    return real3_of(corner[query->axes.x] - query->origin.x,
                    corner[query->axes.y] - query->origin.y,
                    corner[query->axes.z] - query->origin.z);
}

// Returns whether the ray stops on a triangle that its line hits within rounding of the ray's own.
static NOT_INLINE bool stops_on_neighbor(const SceneView *scene, const Ray *ray,
                                         const Corners *corners, bool from_back)
{
    if (ray->own_index == NOTHING)
        return false;
    const Corners own = fetch_corners(scene, ray->own_index);
    return hits_neighbor(&own, corners, ray->direction, from_back);
}

// Returns the distance t at which the ray hits the triangle, INFINITY if it misses.
static inline Real triangle_distance(global const TriangleData *triangle, const Ray *ray,
                                     const Query *query)
{
    const Corners relative = {corner_relative(triangle->a, query),
                              corner_relative(triangle->b, query),
                              corner_relative(triangle->c, query)};
    const Corners sheared = corners_sheared(&relative, &query->shear);
    const Edges edges = edges_of(&sheared);
    if (!edges_contain(&edges))
        return INFINITY;
    const bool front = edges_face(&edges, &query->shear);
    const bool inner = front == ((triangle->material & TRIANGLE_REVERSED) != 0);
    const bool one_sided = (triangle->material & TRIANGLE_TWO_SIDED) == 0;
    if ((one_sided && inner) || triangle->id == ray->own)
        return INFINITY;
    const Real t = triangle_depth(&sheared, &edges) * query->shear.inverse_z;
    if (ray->kind == RAY_CAMERA && !triangle_is_at_origin(t, &query->shear))
        return t > 0.0f ? t : INFINITY;
    const Real error = triangle_depth_error(&sheared) * fabs(query->shear.inverse_z);
    const Corners corners = {load3(triangle->a), load3(triangle->b), load3(triangle->c)};
    const SurfaceRay surface = {ray->origin, front, inner, length_of_ray(ray), blur_of(ray)};
    Mask in_doubt;
    const Real distance = surface_ray_distance(&corners, &surface, t, error, &in_doubt);
    if (in_doubt && stops_on_neighbor(query->scene, ray, &corners, !front))
        return max(t, (Real)(0.0f));
    return distance;
}

// Tests triangles [first, first + count). A shadow ray stops at the first that blocks it.
static inline void intersect_range(const SceneView *scene, const Ray *ray, const Query *query,
                                   uint2 range, Hit *best)
{
    for (uint index = range.x; index < range.x + range.y; index++) {
        global const TriangleData *triangle = &scene->triangles[index];
        const Real t = triangle_distance(triangle, ray, query);
        if (hit_precedes(t, triangle->id, best)) {
            *best = (Hit){t, triangle->id, index};
            if (ray->kind == RAY_SHADOW)
                return;
        }
    }
}

// The stack stores children as 2 * node + child, with the distance at which the ray enters them.
typedef struct {
    uint child[BVH_STACK_SIZE];
    Real entry[BVH_STACK_SIZE];
    uint count;
} PairStack;

static inline void push_child(PairStack *stack, uint child, Real entry)
{
    stack->child[stack->count] = child;
    stack->entry[stack->count] = entry;
    stack->count++;
}

// Pushes the children that the ray enters before `reach`, the nearer one last.
static inline void push_entered_children(const SceneView *scene, uint node, const Query *query,
                                         Real reach, PairStack *stack)
{
    Real2 entry, leave;
    intersect_slabs(&scene->nodes[node], query, reach, &entry, &leave);
    const bool meets_first = entry.x <= leave.x, meets_second = entry.y <= leave.y;
    const bool second_nearer = entry.y < entry.x;
    if (meets_second && !second_nearer)
        push_child(stack, 2 * node + 1, entry.y);
    if (meets_first)
        push_child(stack, 2 * node, entry.x);
    if (meets_second && second_nearer)
        push_child(stack, 2 * node + 1, entry.y);
}

static inline void traverse_tree(const SceneView *scene, const Ray *ray, const Query *query,
                                 Hit *best, Tally *tally)
{
    PairStack stack;
    stack.count = 0;
    push_entered_children(scene, 0, query, best->t, &stack);
    if (CLRT_STATISTICS)
        tally->box_tests += 2;
    while (stack.count > 0) {
        stack.count--;
        if (stack.entry[stack.count] > best->t)
            continue;
        const uint child = stack.child[stack.count];
        const uint first = scene->nodes[child >> 1].first[child & 1];
        const uint count = scene->nodes[child >> 1].count[child & 1];
        if (count == 0) {
            push_entered_children(scene, first, query, best->t, &stack);
            if (CLRT_STATISTICS)
                tally->box_tests += 2;
            continue;
        }
        intersect_range(scene, ray, query, (uint2)(first, count), best);
        if (CLRT_STATISTICS)
            tally->triangle_tests += count;
        if (ray->kind == RAY_SHADOW && best->id != NOTHING)
            return;
    }
}

static void meet_triangles(const SceneView *scene, const FrameData *frame, const Ray *ray,
                           Hit *best, Tally *tally)
{
    const Query query = query_of(scene, ray);
    if (CLRT_BVH && frame->uses_bvh) {
        traverse_tree(scene, ray, &query, best, tally);
        return;
    }
    intersect_range(scene, ray, &query, (uint2)(0, frame->triangle_count), best);
    if (CLRT_STATISTICS)
        tally->triangle_tests += frame->triangle_count;
}

#endif
#endif
