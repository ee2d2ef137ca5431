// SPDX-License-Identifier: MIT
// Traces rays whose directions have zero or denormal components, and unusual rays: rays without
// direction, with NaN or infinity, or from very far away. Unusual rays must end in time and must
// not disturb the rays beside them.
#include "support/exact.h"
#include "support/rig.h"
#include "support/shapes.h"

#include <string.h>
#include <time.h>

// Components of directions: zeros, small and large denormals, small and usual numbers.
static const float components[] = {0.0f,   -0.0f,   1e-45f, -1e-45f, 1e-38f, -1e-38f,
                                   1e-20f, -1e-20f, 0.25f,  -0.25f,  1.0f,   -1.0f};

#define DIRECTIONS (COUNT(components) * COUNT(components) * COUNT(components))
#define INNER_RAYS 100 // per direction

// Returns a ray from a point of the room. Digits of `number` choose the direction's components.
static TestRay special_ray(size_t number, const Room *room, Random *random)
{
    TestRay ray = {.own = NOTHING};
    vec3_store(ray.origin, room_point(room, random));
    for (int axis = 0; axis < 3; axis++, number /= COUNT(components))
        ray.direction[axis] = components[number % COUNT(components)];
    return ray;
}

// A ray from inside a closed shape must hit the shape in every direction. The test skips directions
// shorter than 1e-20. Pictures hardly ever need such directions, and reciprocals of their
// components can overflow.
EXTREME(directions_of_special_values_leave_no_closed_shape_t21)
{
    Random random = {21};
    FREED_BY(rays_free) Rays rays = rays_make(DIRECTIONS * INNER_RAYS);
    FREED_BY(rig_close) Rig rig = rig_open("T-21", *state, shape_scene(shape_cube(1, 5)));
    const Room room = room_inside(&rig.stage, vec3(0, 0, 0), 1);
    rays.count = 0;
    for (size_t i = 0; i < DIRECTIONS * INNER_RAYS; i++) {
        const TestRay ray = special_ray(i / INNER_RAYS, &room, &random);
        if (vec3_extent(vec3_of_floats(ray.direction)) >= (double)1e-20f)
            rays.data[rays.count++] = ray;
    }
    outcome_report(rig_judge(&rig, rays, judge_misses, NULL), "shape=cube");
}

// Fields 0 to 2 are the origin's coordinates, fields 3 to 5 are the direction's, and field 6 is the
// whole direction.
#define FIELDS 7

// Stores value in a field of every fourth ray.
static void spoil(Rays rays, float value, int field)
{
    for (size_t i = 0; i < rays.count; i += 4)
        for (int axis = 0; axis < 3; axis++) {
            if (field == axis)
                rays.data[i].origin[axis] = value;
            if (field == 3 + axis || field == FIELDS - 1)
                rays.data[i].direction[axis] = value;
        }
}

// Returns the number of spoiled rays that hit anything, plus the number of other rays whose hits
// differ from `expected`.
static size_t count_disturbed(const TestHit *hits, const TestHit *expected, size_t count)
{
    size_t disturbed = 0;
    const TestHit nothing = {INFINITY, NOTHING};
    for (size_t i = 0; i < count; i++)
        disturbed += memcmp(&hits[i], i % 4 == 0 ? &nothing : &expected[i], sizeof *hits) != 0;
    return disturbed;
}

// Returns the hits, and stores the least processor time of five runs, in seconds. Other processes
// affect processor time less than they affect elapsed time.
static TestHit *trace_timed(RayBatch *batch, Rays rays, double *seconds)
{
    TestHit *hits = NULL;
    *seconds = INFINITY;
    for (int run = 0; run < 5; run++) {
        free(hits);
        const clock_t start = clock();
        hits = ray_batch_trace(batch, BATCH_NEAREST, rays);
        *seconds = fmin(*seconds, (double)(clock() - start) / CLOCKS_PER_SEC);
    }
    return hits;
}

// Embree's rule: spoiled rays must take at most 2.5 times as long as sound rays.
#define SLOWEST 2.5

static void judge_spoiled(RayBatch *batch, Rays rays, float value)
{
    size_t disturbed = 0;
    double usual, seconds, slowest = 0;
    FREED_BY(rays_free) const Rays spoiled = rays_make(rays.count);
    TestHit *expected = trace_timed(batch, rays, &usual);
    for (int field = 0; field < FIELDS; field++) {
        memcpy(spoiled.data, rays.data, rays.count * sizeof *rays.data);
        spoil(spoiled, value, field);
        TestHit *hits = trace_timed(batch, spoiled, &seconds);
        slowest = fmax(slowest, seconds / usual);
        // A single zero is valid. Only a direction of three zeros is invalid.
        if (value != 0 || field == FIELDS - 1)
            disturbed += count_disturbed(hits, expected, rays.count);
        free(hits);
    }
    free(expected);
    // Tier 0 does not judge times, because other tests run beside this one.
    disturbed += tier() > 0 && slowest > SLOWEST;
    outcome_report(outcome_of("T-23", FIELDS * rays.count, disturbed), "value=%g times=%.2f",
                   (double)value, slowest);
}

EXTREME(rays_without_direction_or_with_nan_hit_nothing_and_end_t23)
{
    static const float values[] = {0, NAN, -NAN, INFINITY, -INFINITY, 0x1p100f};
    Random random = {23};
    FREED_BY(rays_free) const Rays rays = rays_make(tier_size(8192, 65536));
    FREED_BY(rig_close)
    Rig rig = rig_open("T-23", *state, shape_scene(shape_sphere(20, vec3(0, 0, 0))));
    const Room room = room_inside(&rig.stage, vec3(0, 0, 0), 1);
    rays_aim(rays, AIM_RANDOM, &room, &rig.stage.triangles, &random);
    for (size_t i = 0; i < COUNT(values); i++)
        judge_spoiled(*state, rays, values[i]);
}

// A hit is wrong if its distance is NaN or not above 0, or if judge_exactly finds it wrong. clrt
// does not follow rays that start beyond 2^46, so these rays may hit nothing.
static bool judge_far(void *triangles, const Traced *traced)
{
    const float *origin = traced->ray->origin;
    const bool is_followed = vec3_extent(vec3_of_floats(origin)) <= 0x1p46;
    if (!(traced->hit->t > 0))
        return true;
    return judge_exactly(triangles, traced) && (is_followed || traced->hit->id != NOTHING);
}

// Makes rays that start at this distance along an axis and point back. Every second ray is slanted.
static void aim_from(Rays rays, float distance, Random *random)
{
    for (size_t i = 0; i < rays.count; i++) {
        TestRay *ray = &rays.data[i];
        const uint32_t axis = random_below(random, 3);
        const float side = random_below(random, 2) == 0 ? 1 : -1;
        *ray = ray_between(random_in_cube(random, 0.5), vec3(0, 0, 0));
        ray->origin[axis] = side * distance;
        for (uint32_t other = 0; other < 3; other++)
            ray->direction[other] *= i % 2 == 0 ? 0 : 1 / distance;
        ray->direction[axis] = -side;
    }
}

EXTREME(rays_from_very_far_have_the_exact_hit_or_none_t24)
{
    static const float distances[] = {1e3f, 1e6f, 1e9f, 1e12f, 1e18f, 1e24f, 1e30f, 3e38f};
    Random random = {24};
    FREED_BY(rays_free) const Rays rays = rays_make(tier_size(200, 2000));
    FREED_BY(rig_close)
    Rig rig = rig_open("T-24", *state, shape_scene(shape_sphere(20, vec3(0, 0, 0))));
    for (size_t i = 0; i < COUNT(distances); i++) {
        aim_from(rays, distances[i], &random);
        // At larger distances, Embree 3.13.5 crashes with a segmentation fault.
        if (distances[i] > 1e12f)
            peers_close(&rig.peers);
        outcome_report(rig_judge(&rig, rays, judge_far, &rig.stage.triangles), "distance=%g",
                       (double)distances[i]);
    }
}

FIXTURES(ray_batch_setup, ray_batch_teardown)
