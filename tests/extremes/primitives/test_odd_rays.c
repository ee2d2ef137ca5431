// SPDX-License-Identifier: MIT
// Rays that no picture should have: without a direction, not a number, infinite, from very far.
// They meet nothing or what is there, end in time, and leave the rays beside them alone.
#include "support/aim.h"
#include "support/check.h"
#include "support/exact.h"
#include "support/shapes.h"
#include "support/tier.h"
#include "support/trial.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

#define FIELDS 6 // three of the origin and three of the direction

static Scene globe(void)
{
    return shape_scene(shape_sphere(20, vec3(0, 0, 0)));
}

static void set_field(TestRay *ray, int field, float value)
{
    if (field < 3)
        ray->origin[field] = value;
    else
        ray->direction[field - 3] = value;
}

// Every fourth ray has the value in one of its fields; a field past the last is all of the
// direction.
static void spoil(TestRay *rays, size_t count, float value, int field)
{
    for (size_t i = 0; i < count; i += 4)
        for (int component = 0; component < FIELDS; component++)
            if (component == field || (field == FIELDS && component >= 3))
                set_field(&rays[i], component, value);
}

// The answers to the sound rays that are to be expected.
typedef struct {
    const TestHit *expected;
    double seconds;
} Sound;

// Wrong is a spoiled ray that meets anything, or another that no longer meets what it did.
static size_t count_disturbed(void *context, const TestRay *rays, const TestHit *hits, size_t count)
{
    size_t wrong = 0;
    const Sound *sound = context;
    (void)rays;
    for (size_t i = 0; i < count; i++) {
        const TestHit nothing = {INFINITY, NOTHING};
        const TestHit *expected = i % 4 == 0 ? &nothing : &sound->expected[i];
        wrong += memcmp(&hits[i], expected, sizeof *expected) != 0;
    }
    return wrong;
}

// Returns the time of all processors together, which other processes do not increase.
static double seconds_of(RayBatch *batch, const TestRay *rays, size_t count, TestHit *hits)
{
    double least = INFINITY;
    for (int run = 0; run < 5; run++) {
        const clock_t start = clock();
        ray_batch_trace(batch, BATCH_NEAREST, rays, count, hits);
        least = fmin(least, (double)(clock() - start) / CLOCKS_PER_SEC);
    }
    return least;
}

// Embree's own rule: spoiled rays take no more than 2.5 times as long as sound ones.  At tier 0,
// among other tests, time says nothing.
#define SLOWEST 2.5

static size_t judge_spoiled(RayBatch *batch, const TestRay *rays, size_t count, Sound *sound,
                            float value)
{
    size_t wrong = 0;
    char details[64];
    double slowest = 0;
    Error error = {0};
    TestRay *spoiled = aim_make_rays(count);
    TestHit *hits = memory_raw(count, sizeof *hits, &error);
    require(hits != NULL, &error);
    for (int field = 0; field <= FIELDS; field++) {
        memcpy(spoiled, rays, count * sizeof *rays);
        spoil(spoiled, count, value, field);
        const double seconds = seconds_of(batch, spoiled, count, hits);
        slowest = fmax(slowest, seconds / sound->seconds);
        // A single zero is sound; only all of them are not.
        if (value != 0 || field == FIELDS)
            wrong += count_disturbed(sound, spoiled, hits, count);
    }
    free(spoiled);
    free(hits);
    snprintf(details, sizeof details, "value=%g times=%.2f", (double)value, slowest);
    return report_case("T-23", details, (FIELDS + 1) * count,
                       wrong + (tier() > 0 && slowest > SLOWEST));
}

static void rays_of_no_direction_or_no_number_meet_nothing_and_end_t23(void **state)
{
    Stage stage;
    Error error = {0};
    Random random = {23};
    size_t wrong = 0;
    const size_t count = tier_size(8192, 65536);
    const float values[] = {0, NAN, -NAN, INFINITY, -INFINITY, 0x1p100f};
    TestRay *rays = aim_make_rays(count);
    TestHit *hits = memory_raw(count, sizeof *hits, &error);
    require(hits != NULL, &error);
    Scene scene = globe();
    stage_make(&stage, &scene, TREE_SAH);
    const Room room = room_inside(&stage, vec3(0, 0, 0), 1);
    ray_batch_upload(*state, &stage.flat);
    aim_randomly(rays, count, &room, &random);
    Sound sound = {hits, seconds_of(*state, rays, count, hits)};
    for (size_t i = 0; i < sizeof values / sizeof *values; i++)
        wrong += judge_spoiled(*state, rays, count, &sound, values[i]);
    stage_free(&stage);
    scene_free(&scene);
    free(rays);
    free(hits);
    assert_int_equal(wrong, 0);
}

typedef struct {
    const Triangles *triangles;
    float distance;
} Far;

// Wrong is another triangle than the exact one, nothing where there is one, or a distance that is
// no number; from beyond 2^46 of the frame, where no ray is followed, nothing is right.
static size_t count_invalid(void *context, const TestRay *rays, const TestHit *hits, size_t count)
{
    const Far *far = context;
    size_t wrong = 0;
    for (size_t i = 0; i < count; i++) {
        const Verdict verdict = exact_nearest(far->triangles, &rays[i]);
        const bool valid = verdict.id == hits[i].id || !verdict.clear;
        const bool unfollowed = far->distance > 0x1p46f && hits[i].id == NOTHING;
        wrong += !(hits[i].t > 0) || !(valid || unfollowed);
    }
    return wrong;
}

// From afar along an axis, every other a little slanted.
static void aim_from(TestRay *rays, size_t count, float distance, Random *random)
{
    for (size_t i = 0; i < count; i++) {
        const uint32_t axis = random_below(random, 3);
        const float side = random_below(random, 2) == 0 ? 1 : -1;
        rays[i] = aim_at(random_in_cube(random, 0.5), vec3(0, 0, 0));
        rays[i].origin[axis] = side * distance;
        for (uint32_t other = 0; other < 3; other++)
            rays[i].direction[other] = i % 2 == 0 ? 0 : 0.5f * rays[i].direction[other];
        rays[i].direction[axis] = -side;
    }
}

static void rays_from_very_far_meet_what_is_there_or_nothing_t24(void **state)
{
    static const float distances[] = {1e3f, 1e6f, 1e9f, 1e12f, 1e18f, 1e24f, 1e30f, 3e38f};
    Stage stage;
    Trial trial;
    Random random = {24};
    size_t wrong = 0;
    const size_t count = tier_size(200, 2000);
    TestRay *rays = aim_make_rays(count);
    Scene scene = globe();
    stage_make(&stage, &scene, TREE_SAH);
    trial_open(&trial, "T-24", *state, &stage);
    for (size_t i = 0; i < sizeof distances / sizeof *distances; i++) {
        char details[32];
        aim_from(rays, count, distances[i], &random);
        // Embree 3.13.5 ends in a segmentation fault.
        if (distances[i] > 1e12f)
            peers_close(&trial.peers);
        snprintf(details, sizeof details, "distance=%g", (double)distances[i]);
        Far far = {&stage.triangles, distances[i]};
        wrong += trial_judge(&trial, details, rays, count, &(Judgment){count_invalid, &far});
    }
    trial_close(&trial);
    stage_free(&stage);
    scene_free(&scene);
    free(rays);
    assert_int_equal(wrong, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_of_no_direction_or_no_number_meet_nothing_and_end_t23),
        cmocka_unit_test(rays_from_very_far_meet_what_is_there_or_nothing_t24),
    };
    return cmocka_run_group_tests(tests, ray_batch_setup, ray_batch_teardown);
}
