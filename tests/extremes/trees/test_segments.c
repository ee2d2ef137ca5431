// SPDX-License-Identifier: MIT
// A shadow ray stops at any hit, a camera ray at the nearest. Between the same points, both must
// find something or nothing.
#include "support/rig.h"
#include "support/shapes.h"

// For hits this close to an end, the side on which the end is decides.
#define NEAR_END 1e-4f

typedef enum {
    SEGMENT_FREE,     // between any two points
    SEGMENT_SURFACE,  // starts on a triangle, its own
    SEGMENT_ON_LIGHT, // ends exactly on a face
    SEGMENT_KINDS
} SegmentKind;

static const char *const segment_names[SEGMENT_KINDS] = {"free", "surface", "on_light"};

// Returns a point of the cube's face at z = 0.5. Its coordinates are multiples of 2^-10.
static Vec3 point_of_face(Random *random)
{
    const double x = random_below(random, 1025) * 0x1p-10 - 0.5;
    return vec3(x, random_below(random, 1025) * 0x1p-10 - 0.5, 0.5);
}

static TestRay segment_from_surface(const Triangles *triangles, Vec3 light, Random *random)
{
    const uint32_t triangle = random_below(random, (uint32_t)triangles->count);
    const double u = random_between(random, 0, 1), v = random_between(random, 0, 1 - u);
    TestRay ray = ray_between(point_of(triangles, triangle, u, v), light);
    ray.own = triangle;
    return ray;
}

static void make_segments(Rays rays, SegmentKind kind, const Triangles *triangles, Random *random)
{
    Vec3 light = {0};
    for (size_t i = 0; i < rays.count; i++) {
        if (rays_move_origin(i, 64))
            light = kind == SEGMENT_ON_LIGHT ? point_of_face(random) : random_in_cube(random, 2);
        rays.data[i] = kind == SEGMENT_SURFACE ? segment_from_surface(triangles, light, random)
                                               : ray_between(random_in_cube(random, 2), light);
    }
}

// Returns whether the nearest hit is too close to an end to judge.
static bool is_unclear(const TestRay *ray, const TestHit *nearest)
{
    if (nearest->id == ray->own && nearest->id != NOTHING)
        return nearest->t <= NEAR_END;
    return nearest->t <= NEAR_END || fabsf(nearest->t - 1) <= NEAR_END;
}

static void judge_segments(RayBatch *batch, const char *name, const Triangles *triangles,
                           SegmentKind kind)
{
    Random random = {(uint64_t)(26 + kind)};
    size_t wrong = 0, judged = 0, blocked = 0;
    const Rays rays = rays_make(tier_size(10000, 100000));
    make_segments(rays, kind, triangles, &random);
    TestHit *nearest = ray_batch_trace(batch, BATCH_NEAREST, rays);
    for (size_t i = 0; i < rays.count; i++)
        rays.data[i].kind = RAY_SHADOW;
    TestHit *any = ray_batch_trace(batch, BATCH_BLOCKED, rays);
    for (size_t i = 0; i < rays.count; i++) {
        const bool stands_between = nearest[i].t < 1 && nearest[i].id != rays.data[i].own;
        if (is_unclear(&rays.data[i], &nearest[i]))
            continue;
        judged++;
        blocked += stands_between;
        wrong += stands_between != (any[i].id == 1);
    }
    outcome_report(outcome_of("T-26", judged, wrong), "scene=%s segments=%s blocked=%zu", name,
                   segment_names[kind], blocked);
    assert_in_range(judged, rays.count / 4, rays.count);
    free(rays.data);
    free(nearest);
    free(any);
}

static void judge_scene(RayBatch *batch, const char *name, Mesh mesh)
{
    Rig rig = rig_open("T-26", batch, shape_scene(mesh));
    for (SegmentKind kind = 0; kind < SEGMENT_KINDS; kind++)
        judge_segments(batch, name, &rig.stage.triangles, kind);
    rig_close(&rig);
}

static void anything_between_two_points_is_what_the_nearest_hit_says_t26(void **state)
{
    Random random = {2626};
    judge_scene(*state, "cube", shape_cube(4, 8));
    judge_scene(*state, "soup", shape_soup(&random, 200, 0.3));
    judge_scene(*state, "globe", shape_sphere(16, vec3(0, 0, 0)));
}

RUN_TESTS(ray_batch_setup, ray_batch_teardown,
          EXTREME(anything_between_two_points_is_what_the_nearest_hit_says_t26))
