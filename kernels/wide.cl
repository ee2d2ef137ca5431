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

// A ray as scalars; arrays of three are by axis.
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
                                     const WideEdges *edges)
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
    const float8 error = triangle_depth_error(sheared) * fabs(shear->inverse_z);
    const WideCorners corners = {block_corner(block, 0), block_corner(block, 1),
                                 block_corner(block, 2)};
    const Wide3 point = {ray->surface[0], ray->surface[1], ray->surface[2]};
    const WideSurfaceRay surface = {point, front, is_shadow};
    return closed ? surface_ray_distance(&corners, &surface, t, error) : INFINITY;
}

// Tests the triangles of a block against the ray.
static inline void test_block(global const TriangleBlock *blocks, uint number, const SingleRay *ray,
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
    const float8 t = block_distances(block, ray, &shear, &sheared, &edges);
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

static inline void traverse_wide(const SceneView *scene, const SingleRay *ray, SingleHit *best,
                                 Tally *tally)
{
    WideWaiting waiting;
    waiting.count = 0;
    uint child = 0;
    do {
        while ((child & WIDE_LEAF) == 0) {
            global const BvhWide *node = &scene->nodes[child];
            const uint8 children = vload8(0, node->child);
            float8 entry;
            const uint met = lane_bits(children_met(node, ray, best->t, &entry));
            if (CLRT_STATISTICS)
                tally->box_tests += node->child_count;
            if (met == 0)
                break;
            child = enter_children(&waiting, &children, met, &entry);
        }
        if ((child & WIDE_LEAF) == 0)
            continue;
        test_block(scene->triangles, child & ~WIDE_LEAF, ray, best);
        if (CLRT_STATISTICS)
            tally->triangle_tests += WIDE;
        if (ray->kind == RAY_SHADOW && best->id != NOTHING)
            return;
    } while (next_child(&waiting, best->t, &child));
}

static inline float slab_direction(float direction, float smallest)
{
    return fabs(direction) < smallest ? copysign(smallest, direction) : direction;
}

static void meet_blocks(const SceneView *scene, const FrameData *frame, const SingleRay *ray,
                        SingleHit *best, Tally *tally)
{
    if (CLRT_BVH && frame->uses_bvh) {
        traverse_wide(scene, ray, best, tally);
        return;
    }
    for (uint block = 0; block * WIDE < frame->triangle_count; block++) {
        test_block(scene->triangles, block, ray, best);
        if (ray->kind == RAY_SHADOW && best->id != NOTHING)
            break;
    }
    if (CLRT_STATISTICS)
        tally->triangle_tests += frame->triangle_count;
}

#if CLRT_LANES == 1
static inline void slab_constants(SingleRay *ray, uint axis, float direction, float slack)
{
    const float widening = copysign(slack, direction), inverse = 1.0f / direction;
    ray->inverse[axis] = inverse;
    ray->near_offset[axis] = -(ray->origin[axis] + widening) * inverse;
    ray->far_offset[axis] = -(ray->origin[axis] - widening) * inverse;
    ray->negative[axis] = direction < 0.0f;
}

static inline SingleRay single_ray(const Ray *ray)
{
    const ShearAxes axes = shear_axes(ray->direction);
    const Shear shear = shear_along(ray->direction, &axes);
    const float smallest = 0x1p-30f * largest_component(ray->direction);
    const float slack = BVH_SLACK * largest_component(ray->origin);
    SingleRay single = {.axes = {axes.x, axes.y, axes.z},
                        .origin = {ray->origin.x, ray->origin.y, ray->origin.z},
                        .shear_x = shear.shear_x,
                        .shear_y = shear.shear_y,
                        .inverse_z = shear.inverse_z,
                        .direction_z = shear.direction_z,
                        .surface = {ray->surface.x, ray->surface.y, ray->surface.z},
                        .own = ray->own,
                        .kind = ray->kind};
    slab_constants(&single, 0, slab_direction(ray->direction.x, smallest), slack);
    slab_constants(&single, 1, slab_direction(ray->direction.y, smallest), slack);
    slab_constants(&single, 2, slab_direction(ray->direction.z, smallest), slack);
    return single;
}

static void meet_triangles(const SceneView *scene, const FrameData *frame, const Ray *ray,
                           Hit *best, Tally *tally)
{
    const SingleRay single = single_ray(ray);
    SingleHit hit = {best->t, best->id, best->index};
    meet_blocks(scene, frame, &single, &hit, tally);
    *best = (Hit){hit.t, hit.id, hit.index};
}
#endif

#endif
#endif
