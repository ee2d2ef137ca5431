// SPDX-License-Identifier: MIT
// Triangles a thousand to ten million times as long as they are high: distances stay exact to a few
// units in the last place, and what is met stays so but for rays on the very outline.
#include "support/aim.h"
#include "support/check.h"
#include "support/exact.h"
#include "support/rotation.h"
#include "support/shapes.h"
#include "support/tier.h"
#include "support/trial.h"

#include <stdlib.h>

#define TRIANGLES  100
#define ULPS_LIMIT 16
#define PROGRAMS   3 // clrt and both modes of Embree

// How far the distances are off that each program reports for the rays of a shape.
typedef struct {
    float (*corners)[3][3]; // of the triangle each ray is for
    float *errors[PROGRAMS];
    size_t met[PROGRAMS], wrong_sides[PROGRAMS];
    int program;
} Record;

static double unit_in_last_place(double value)
{
    return scalbn(1, ilogb(value) - 23);
}

// Whether rounding may decide: the ray passes the outline by less than 4 units in the last place.
static bool is_on_outline(const ExactMeeting *exact)
{
    return exact->distance < 4 * unit_in_last_place(exact->size);
}

static size_t count_inexact(void *context, const TestRay *rays, const TestHit *hits, size_t count)
{
    Record *record = context;
    size_t inexact = 0;
    const int program = record->program;
    for (size_t i = 0; i < count; i++) {
        const ExactMeeting exact = exact_meeting((const float(*)[3])record->corners[0], &rays[i]);
        const bool met = hits[i].id != NOTHING;
        record->wrong_sides[program] += met != exact.met && !is_on_outline(&exact);
        if (!met || !exact.met)
            continue;
        const double error = fabs((double)hits[i].t - exact.t) / unit_in_last_place(exact.t);
        record->errors[program][record->met[program]++] = (float)error;
        inexact += !(error <= ULPS_LIMIT);
    }
    record->program = (program + 1) % PROGRAMS;
    return inexact;
}

// Along x, a length of 1, and so high, turned at random.
static Scene sliver(double aspect, Random *random)
{
    Vec3 axes[3];
    random_rotation(random, axes);
    const Vec3 a = vec3_scale(axes[0], -0.5), b = vec3_scale(axes[0], 0.5);
    const Vec3 c = vec3_add(vec3_scale(axes[0], random_between(random, -0.5, 0.5)),
                            vec3_scale(axes[1], 1 / aspect));
    return shape_scene(shape_triangle(a, b, c));
}

static void aim_inside(TestRay *rays, size_t count, const StageTriangle *triangle, Random *random)
{
    Vec3 origin = {0}, corners[3];
    for (int i = 0; i < 3; i++)
        corners[i] = vec3((double)triangle->corners[i][0], (double)triangle->corners[i][1],
                          (double)triangle->corners[i][2]);
    for (size_t i = 0; i < count; i++) {
        const double u = random_between(random, 0, 1), v = random_between(random, 0, 1 - u);
        if (aim_moves_origin(i, 64))
            origin = vec3_scale(vec3_normalize(random_in_cube(random, 1)), 3);
        rays[i] =
            aim_at(origin,
                   vec3_add(corners[0], vec3_add(vec3_scale(vec3_sub(corners[1], corners[0]), u),
                                                 vec3_scale(vec3_sub(corners[2], corners[0]), v))));
    }
}

static Fails trace_sliver(RayBatch *batch, double aspect, size_t count, Record *record,
                          Random *random)
{
    Stage stage;
    Trial trial;
    TestRay *rays = aim_make_rays(count);
    Scene scene = sliver(aspect, random);
    stage_make(&stage, &scene, TREE_SAH);
    StageTriangle triangle = stage_triangle(&stage.triangles, 0);
    record->corners = &triangle.corners;
    aim_inside(rays, count, &triangle, random);
    trial_open(&trial, "T-10", batch, &stage);
    record->program = 0;
    const Fails fails = trial_fails(&trial, rays, count, &(Judgment){count_inexact, record});
    trial_close(&trial);
    stage_free(&stage);
    scene_free(&scene);
    free(rays);
    return fails;
}

static int compare_floats(const void *first, const void *second)
{
    const float *a = first, *b = second;
    return (*a > *b) - (*a < *b);
}

// The value that a part of all errors lie below; sorts them.
static double percentile(Record *record, int program, double part)
{
    const size_t count = record->met[program];
    qsort(record->errors[program], count, sizeof(float), compare_floats);
    return count > 0 ? (double)record->errors[program][(size_t)(part * (double)(count - 1))] : 0;
}

static size_t report_slivers(double aspect, size_t rays, const Fails *fails, Record *record)
{
    char details[160];
    int length = snprintf(details, sizeof details, "aspect=%g median_ulp=%.2f p99_ulp=%.2f", aspect,
                          percentile(record, 0, 0.5), percentile(record, 0, 0.99));
    if (fails->peers.known)
        snprintf(details + length, sizeof details - (size_t)length,
                 " embree_default_p99_ulp=%.3g embree_robust_p99_ulp=%.3g",
                 percentile(record, 1, 0.99), percentile(record, 2, 0.99));
    const size_t past = report(
        &(Case){"T-10", details, record->met[0], fails->ours, record->met[0] / 100, fails->peers});
    snprintf(details, sizeof details, "aspect=%g sides", aspect);
    const PeerFails sides = {fails->peers.known, record->wrong_sides[1], record->wrong_sides[2]};
    return past + report(&(Case){"T-10", details, rays, record->wrong_sides[0], 0, sides});
}

static size_t judge_slivers(RayBatch *batch, double aspect)
{
    Error error = {0};
    Fails fails = {0};
    Record record = {0};
    Random random = {10};
    const size_t each = tier_size(200, 2000), count = TRIANGLES * each;
    for (int program = 0; program < PROGRAMS; program++) {
        record.errors[program] = memory_raw(count, sizeof(float), &error);
        require(record.errors[program] != NULL, &error);
    }
    for (int i = 0; i < TRIANGLES; i++) {
        const Fails more = trace_sliver(batch, aspect, each, &record, &random);
        fails_add(&fails, &more);
    }
    assert_true(record.met[0] > count / 50);
    const size_t past = report_slivers(aspect, count, &fails, &record);
    for (int program = 0; program < PROGRAMS; program++)
        free(record.errors[program]);
    return past;
}

static void distances_to_slivers_are_exact_to_16_units_in_the_last_place_t10(void **state)
{
    size_t past = judge_slivers(*state, 1e3);
    past += judge_slivers(*state, 1e5);
    past += judge_slivers(*state, 1e7);
    assert_int_equal(past, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distances_to_slivers_are_exact_to_16_units_in_the_last_place_t10),
    };
    return cmocka_run_group_tests(tests, ray_batch_setup, ray_batch_teardown);
}
