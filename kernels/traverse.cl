// SPDX-License-Identifier: MIT
// Finds what a ray meets: the hit with the smallest (distance, id) of all primitives, or whether
// anything blocks a shadow ray.  Boxes only cull, and never a triangle the exact test would accept:
// each is grown by BVH_SLACK times its largest coordinate by the host, and the ray's origin is
// moved against each plane by BVH_SLACK times its largest coordinate here, which covers the
// rounding of the triangle's acceptance and of the slabs (shared.h).  So the answer is the same
// for every tree, for every order of visits and for no tree at all.
#ifndef CLRT_TRAVERSE_CL
#define CLRT_TRAVERSE_CL
#include "sphere.cl"
#include "triangle.cl"

typedef struct {
    uint camera_rays, shadow_rays, reflected_rays, shaded_points, camera_hits;
    uint triangle_tests, box_tests, sphere_tests;
} Tally;

// The arrays of the flattened scene, gathered so that they travel as one parameter.
typedef struct {
    global const PointLight *lights;
    global const Material *materials;
    global const SphereData *spheres;
    global const BvhPair *nodes;
    global const TriangleData *triangles;
    global const CornerNormals *normals;
} SceneView;

// index counts in the array of the primitive's kind; spheres have the ids below sphere_count.
typedef struct {
    float t; // along the ray; INFINITY while nothing is hit
    uint id, index;
} Hit;

// The ray as six planes' constants: distance to a plane = fma(plane, inverse, offset).  A zero
// direction is replaced by 2^-30 of the largest, so that no infinity or NaN can arise from rays
// whose largest component is above 2^-96; shorter ones have no length to speak of.
typedef struct {
    float3 inverse, near_offset, far_offset;
    uint negative_x, negative_y, negative_z; // which plane of each axis the ray meets first
} Slabs;

static inline float slab_direction(float direction, float smallest)
{
    return fabs(direction) < smallest ? copysign(smallest, direction) : direction;
}

static inline Slabs slabs_of(const Ray *ray)
{
    const float smallest = 0x1p-30f * largest_component(ray->direction);
    const float slack = BVH_SLACK * largest_component(ray->origin);
    const float3 direction = (float3)(slab_direction(ray->direction.x, smallest),
                                      slab_direction(ray->direction.y, smallest),
                                      slab_direction(ray->direction.z, smallest));
    const float3 widening = copysign((float3)(slack), direction);
    Slabs slabs;
    slabs.inverse = 1.0f / direction;
    slabs.near_offset = -(ray->origin + widening) * slabs.inverse;
    slabs.far_offset = -(ray->origin - widening) * slabs.inverse;
    slabs.negative_x = direction.x < 0.0f;
    slabs.negative_y = direction.y < 0.0f;
    slabs.negative_z = direction.z < 0.0f;
    return slabs;
}

static inline float2 plane_pair(global const BvhPair *node, uint axis, uint side)
{
    return (float2)(node->planes[axis][side][0], node->planes[axis][side][1]);
}

// Where the ray is inside both children's boxes: [entry, leave], empty where it misses.
static inline void slabs_meet(global const BvhPair *node, const Slabs *slabs, float reach,
                              float2 *entry, float2 *leave)
{
    const float2 near_x = fma(plane_pair(node, 0, slabs->negative_x), (float2)(slabs->inverse.x),
                              (float2)(slabs->near_offset.x));
    const float2 near_y = fma(plane_pair(node, 1, slabs->negative_y), (float2)(slabs->inverse.y),
                              (float2)(slabs->near_offset.y));
    const float2 near_z = fma(plane_pair(node, 2, slabs->negative_z), (float2)(slabs->inverse.z),
                              (float2)(slabs->near_offset.z));
    const float2 far_x = fma(plane_pair(node, 0, 1 - slabs->negative_x), (float2)(slabs->inverse.x),
                             (float2)(slabs->far_offset.x));
    const float2 far_y = fma(plane_pair(node, 1, 1 - slabs->negative_y), (float2)(slabs->inverse.y),
                             (float2)(slabs->far_offset.y));
    const float2 far_z = fma(plane_pair(node, 2, 1 - slabs->negative_z), (float2)(slabs->inverse.z),
                             (float2)(slabs->far_offset.z));
    *entry = max(max(near_x, near_y), max(near_z, (float2)(0.0f)));
    *leave = min(min(far_x, far_y), min(far_z, (float2)(reach)));
}

// Equal distances go to the lowest id, whatever the order of the tests.
static inline bool hit_precedes(float t, uint id, const Hit *best)
{
    return t < best->t || (t == best->t && id < best->id && t < INFINITY);
}

// Tests triangles [first, first + count); a shadow ray is content with the first that blocks it.
static inline void test_triangles(const SceneView *scene, const Ray *ray, const Shear *shear,
                                  uint2 range, Hit *best)
{
    for (uint index = range.x; index < range.x + range.y; index++) {
        global const TriangleData *triangle = &scene->triangles[index];
        const float t = triangle_distance(triangle, ray, shear);
        if (hit_precedes(t, triangle->id, best)) {
            *best = (Hit){t, triangle->id, index};
            if (ray->kind == RAY_SHADOW)
                return;
        }
    }
}

// Children wait on the stack as 2 * node + child, beside the distance at which they are entered.
typedef struct {
    uint child[BVH_STACK_SIZE];
    float entry[BVH_STACK_SIZE];
    uint count;
} Waiting;

static inline void wait_for_child(Waiting *waiting, uint child, float entry)
{
    waiting->child[waiting->count] = child;
    waiting->entry[waiting->count] = entry;
    waiting->count++;
}

// Puts the children that the ray meets before `reach` on the stack, the nearer one on top.
static inline void wait_for_children(const SceneView *scene, uint node, const Slabs *slabs,
                                     float reach, Waiting *waiting)
{
    float2 entry, leave;
    slabs_meet(&scene->nodes[node], slabs, reach, &entry, &leave);
    const bool meets_first = entry.x <= leave.x, meets_second = entry.y <= leave.y;
    const bool second_nearer = entry.y < entry.x;
    if (meets_second && !second_nearer)
        wait_for_child(waiting, 2 * node + 1, entry.y);
    if (meets_first)
        wait_for_child(waiting, 2 * node, entry.x);
    if (meets_second && second_nearer)
        wait_for_child(waiting, 2 * node + 1, entry.y);
}

static void traverse_tree(const SceneView *scene, const Ray *ray, const Shear *shear, Hit *best,
                          Tally *tally)
{
    const Slabs slabs = slabs_of(ray);
    Waiting waiting;
    waiting.count = 0;
    wait_for_children(scene, 0, &slabs, best->t, &waiting);
    if (CLRT_STATISTICS)
        tally->box_tests += 2;
    while (waiting.count > 0) {
        waiting.count--;
        if (waiting.entry[waiting.count] > best->t)
            continue;
        const uint child = waiting.child[waiting.count];
        const uint first = scene->nodes[child >> 1].first[child & 1];
        const uint count = scene->nodes[child >> 1].count[child & 1];
        if (count == 0) {
            wait_for_children(scene, first, &slabs, best->t, &waiting);
            if (CLRT_STATISTICS)
                tally->box_tests += 2;
            continue;
        }
        test_triangles(scene, ray, shear, (uint2)(first, count), best);
        if (CLRT_STATISTICS)
            tally->triangle_tests += count;
        if (ray->kind == RAY_SHADOW && best->id != NOTHING)
            return;
    }
}

// A shadow ray is followed from the surface here: two-float distances are exact enough to see what
// touches the surface, from the light they are not.
static inline void meet_spheres(const SceneView *scene, const FrameData *frame, const Ray *ray,
                                Hit *best, Tally *tally)
{
    const bool is_shadow = ray->kind == RAY_SHADOW;
    const float3 origin = is_shadow ? ray->surface : ray->origin;
    const float3 direction = is_shadow ? -ray->direction : ray->direction;
    for (uint index = 0; index < frame->sphere_count; index++) {
        global const SphereData *sphere = &scene->spheres[index];
        float t = INFINITY;
        if (index != ray->own)
            t = sphere_distance(sphere, origin, direction);
        else if (ray->kind == RAY_REFLECTED)
            t = sphere_chord(sphere, origin, direction);
        if (hit_precedes(t, index, best))
            *best = (Hit){t, index, index};
        if (CLRT_STATISTICS)
            tally->sphere_tests++;
    }
}

static inline void meet_triangles(const SceneView *scene, const FrameData *frame, const Ray *ray,
                                  Hit *best, Tally *tally)
{
    if (frame->triangle_count == 0)
        return;
    const Shear shear = shear_along(ray);
    if (CLRT_BVH && frame->uses_bvh) {
        traverse_tree(scene, ray, &shear, best, tally);
        return;
    }
    test_triangles(scene, ray, &shear, (uint2)(0, frame->triangle_count), best);
    if (CLRT_STATISTICS)
        tally->triangle_tests += frame->triangle_count;
}

static inline Hit nearest_hit(const SceneView *scene, const FrameData *frame, const Ray *ray,
                              Tally *tally)
{
    Hit best = {INFINITY, NOTHING, NOTHING};
    if (CLRT_SPHERES)
        meet_spheres(scene, frame, ray, &best, tally);
    if (CLRT_TRIANGLES)
        meet_triangles(scene, frame, ray, &best, tally);
    return best;
}

// Whether anything stands between the light and the shaded point of a shadow ray.  Triangles are
// looked for a little past the point: which side of it they are on is decided exactly there.
static inline bool is_blocked(const SceneView *scene, const FrameData *frame, const Ray *ray,
                              Tally *tally)
{
    Hit best = {1.0f, NOTHING, NOTHING};
    if (CLRT_SPHERES)
        meet_spheres(scene, frame, ray, &best, tally);
    if (best.id != NOTHING)
        return true;
    best.t = 1.0f + 0x1p-10f;
    if (CLRT_TRIANGLES)
        meet_triangles(scene, frame, ray, &best, tally);
    return best.id != NOTHING;
}

#endif
