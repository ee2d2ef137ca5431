// SPDX-License-Identifier: MIT
// Ten thousand triangles share a vertex. Rays at this vertex and at edges hit several triangles at
// one distance, and the lowest id must win.
#include "support/rig.h"
#include "support/shapes.h"

#define TRIANGLES 10000
#define RAYS      50000

// Returns a point above the fan. The fan's apex is the origin of normalized coordinates.
static Vec3 point_above(Random *random)
{
    Vec3 point = random_in_cube(random, 0.5);
    point.z = random_between(random, 0.5, 2);
    return point;
}

// At z = 1 the shear is exact, so half of the rays hit the apex itself and all triangles.
static void aim_at_apex(Rays rays, Random *random)
{
    Vec3 origin = {0};
    for (size_t i = 0; i < rays.count; i++) {
        if (rays_move_origin(i, 8))
            origin = point_above(random);
        if (random_below(random, 2) == 0)
            origin.z = 1;
        rays.data[i] = ray_between(origin, vec3(0, 0, 0));
    }
}

static void aim_along_spokes(Rays rays, const Triangles *triangles, Random *random)
{
    Vec3 origin = {0};
    for (size_t i = 0; i < rays.count; i++) {
        if (rays_move_origin(i, 64))
            origin = point_above(random);
        const uint32_t triangle = random_below(random, TRIANGLES);
        rays.data[i] =
            ray_between(origin, point_of(triangles, triangle, random_between(random, 0, 0.95), 0));
    }
}

// Returns the nearest of all triangles, with the lowest id. *equals becomes the number of triangles
// at that distance.
static TestHit nearest_of(const TestHit *each, size_t *equals)
{
    TestHit nearest = {INFINITY, NOTHING};
    *equals = 0;
    for (int i = 0; i < TRIANGLES; i++) {
        if (each[i].t < nearest.t)
            *equals = 0;
        *equals += each[i].t <= nearest.t && each[i].t < INFINITY;
        if (each[i].t < nearest.t || (each[i].t == nearest.t && each[i].id < nearest.id))
            nearest = each[i];
    }
    return nearest;
}

// Returns whether the hit is the nearest. Different doubles can be one float in `each`, and then
// any of their triangles is right.
static bool is_nearest(RayBatch *batch, const TestHit *hit, const TestHit *nearest,
                       const TestHit *each)
{
    if (batch->choice.precision == PRECISION_FP64)
        return hit->id < TRIANGLES && each[hit->id].t == nearest->t && hit->t == nearest->t;
    return hit->id == nearest->id && hit->t == nearest->t;
}

// Compares some rays' hits with the nearest of all triangles. Returns the number of rays that hit
// several triangles at one distance.
static size_t judge_ids(RayBatch *batch, Rays rays, const char *aim)
{
    size_t wrong = 0, ties = 0;
    rays.count = tier_size(50, 1000);
    TestHit *each = require_memory(TRIANGLES, sizeof *each);
    TestHit *hits = ray_batch_trace(batch, BATCH_NEAREST, rays);
    for (size_t i = 0; i < rays.count; i++) {
        size_t equals;
        ray_batch_each(batch, &rays.data[i], each);
        const TestHit nearest = nearest_of(each, &equals);
        wrong += !is_nearest(batch, &hits[i], &nearest, each);
        ties += equals > 1;
    }
    outcome_report(outcome_of("T-07", rays.count, wrong), "answer=%s", aim);
    free(hits);
    free(each);
    return ties;
}

EXTREME(rays_at_a_fan_hit_its_lowest_triangle_t07)
{
    Random random = {7};
    FREED_BY(rays_free) const Rays rays = rays_make(RAYS);
    FREED_BY(rig_close) Rig rig = rig_open("T-07", *state, shape_scene(shape_fan(TRIANGLES)));
    aim_at_apex(rays, &random);
    outcome_report(rig_judge(&rig, rays, judge_misses, NULL), "aim=apex");
    // The test needs rays that hit several triangles at one distance.
    assert_in_range(judge_ids(*state, rays, "apex"), tier_size(50, 1000) / 4, RAYS);
    aim_along_spokes(rays, &rig.stage.triangles, &random);
    outcome_report(rig_judge(&rig, rays, judge_misses, NULL), "aim=spokes");
    judge_ids(*state, rays, "spokes");
}

FIXTURES(ray_batch_setup, ray_batch_teardown)
