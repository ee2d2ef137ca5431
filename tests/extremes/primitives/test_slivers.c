// SPDX-License-Identifier: MIT
// Traces rays at triangles that are a thousand to ten million times as long as high. At least 99 %
// of the distances must be exact to ULPS_LIMIT units in the last place, and hits must be right
// except at the outline.
#include "support/exact.h"
#include "support/rig.h"
#include "support/shapes.h"

#include <string.h>

#define TRIANGLES  100
#define ULPS_LIMIT 16

typedef struct {
    const Triangles *triangle;
    size_t met[TRACERS], wrong_sides[TRACERS];
} Record;

static double unit_in_last_place(double value)
{
    return scalbn(1, ilogb(value) - 23);
}

// Returns whether rounding may decide the hit, because the ray passes the outline at a distance of
// less than 4 units in the last place of exact->size.
static bool is_on_outline(const ExactMeeting *exact)
{
    return exact->distance < 4 * unit_in_last_place(exact->size);
}

static bool judge_distance(void *context, const Traced *traced)
{
    Record *record = context;
    const RayTracer tracer = traced->tracer;
    const ExactMeeting exact = exact_meeting(record->triangle, 0, traced->ray);
    const bool met = traced->hit->id != NOTHING;
    record->wrong_sides[tracer] += met != exact.met && !is_on_outline(&exact);
    if (!met || !exact.met)
        return false;
    record->met[tracer]++;
    return !(fabs((double)traced->hit->t - exact.t) <= ULPS_LIMIT * unit_in_last_place(exact.t));
}

// Returns a triangle of length 1 and height 1 / aspect, randomly rotated.
static Scene sliver(double aspect, Random *random)
{
    Vec3 axes[3];
    random_rotation(random, axes);
    const Vec3 top = vec3(random_between(random, -0.5, 0.5), 1 / aspect, 0);
    return shape_scene(
        shape_triangle(vec3_scale(axes[0], -0.5), vec3_scale(axes[0], 0.5), rotated(axes, top)));
}

static Outcome judge_sliver(RayBatch *batch, double aspect, Record *record, Random *random)
{
    Vec3 origin = {0};
    FREED_BY(rays_free) const Rays rays = rays_make(tier_size(200, 2000));
    FREED_BY(rig_close) Rig rig = rig_open("T-10", batch, sliver(aspect, random));
    record->triangle = &rig.stage.triangles;
    for (size_t i = 0; i < rays.count; i++) {
        const double u = random_between(random, 0, 1), v = random_between(random, 0, 1 - u);
        if (rays_move_origin(i, 64))
            origin = vec3_scale(random_direction(random), 3);
        rays.data[i] = ray_between(origin, point_of(record->triangle, 0, u, v));
    }
    return rig_judge(&rig, rays, judge_distance, record);
}

static void judge_slivers(RayBatch *batch, double aspect)
{
    Outcome sum = {0};
    Record record = {0};
    Random random = {10};
    for (int i = 0; i < TRIANGLES; i++)
        outcome_add(&sum, judge_sliver(batch, aspect, &record, &random));
    assert_true(record.met[BY_CLRT] > sum.count / 50);
    Outcome sides = sum;
    memcpy(sides.failures, record.wrong_sides, sizeof sides.failures);
    sum.count = record.met[BY_CLRT];
    sum.limit = sum.count / 100;
    outcome_report(sum, "aspect=%g", aspect);
    outcome_report(sides, "aspect=%g sides", aspect);
}

EXTREME(distances_to_slivers_are_exact_to_16_units_in_the_last_place_t10)
{
    judge_slivers(*state, 1e3);
    judge_slivers(*state, 1e5);
    judge_slivers(*state, 1e7);
}

FIXTURES(ray_batch_setup, ray_batch_teardown)
