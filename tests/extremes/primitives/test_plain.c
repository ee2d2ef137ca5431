// SPDX-License-Identifier: MIT
// Ten million triangles in one plane, a lattice: rays of dyadic numbers, for which every step is
// exact, meet the very cell that they point at, grazing ones too.
#include "support/aim.h"
#include "support/check.h"
#include "support/shapes.h"
#include "support/tier.h"
#include "support/trial.h"

#include <stdlib.h>

// The plane fills [0, cells]^2 of the file, whose frame is 2^-exponent as large.
typedef struct {
    uint32_t cells;
    double unit; // a cell's side in the frame
    uint32_t *expected;
} Plain;

// The triangle that holds the point: those of a cell share its diagonal.
static uint32_t triangle_at(const Plain *plain, double x, double y)
{
    const double column = floor(x), row = floor(y);
    const uint32_t cell = (uint32_t)row * plain->cells + (uint32_t)column;
    return 2 * cell + (x - column > y - row ? 0 : 1);
}

// An odd number of sixteenths: on no line of the lattice.
static double between_lines(const Plain *plain, Random *random)
{
    return (2 * random_below(random, 8 * plain->cells) + 1) / 16.0;
}

// A ray to that point of the plane along (x, y, -z) steps of the unit.
static TestRay ray_to(const Plain *plain, Vec3 target, Vec3 steps, double count)
{
    const double half = plain->cells / 2.0;
    const double to[3] = {target.x - half, target.y - half, 0};
    const double along[3] = {steps.x, steps.y, steps.z};
    TestRay ray = {.own = NOTHING, .kind = RAY_CAMERA};
    for (int axis = 0; axis < 3; axis++) {
        const double origin = (to[axis] - count * along[axis]) * plain->unit;
        ray.origin[axis] = (float)origin;
        ray.direction[axis] = (float)along[axis];
        assert_true((double)ray.origin[axis] == origin &&
                    (double)ray.direction[axis] == along[axis]);
    }
    return ray;
}

// Straight down, along a slope, and grazing at a millionth.
static TestRay random_ray(Plain *plain, size_t place, Random *random)
{
    Vec3 target = {between_lines(plain, random), between_lines(plain, random), 0};
    while (target.x - floor(target.x) == target.y - floor(target.y))
        target.x = between_lines(plain, random);
    const double x = (int)random_below(random, 33) - 16, y = (int)random_below(random, 33) - 16;
    plain->expected[place] = triangle_at(plain, target.x, target.y);
    if (place % 3 == 0)
        return ray_to(plain, target, vec3(0, 0, -1), 64);
    if (place % 3 == 1)
        return ray_to(plain, target, vec3(x / 32, y / 32, -1), 32);
    return ray_to(plain, target, vec3(1, y / 16, -0x1p-20), 32);
}

static size_t count_others(void *context, const TestRay *rays, const TestHit *hits, size_t count)
{
    size_t wrong = 0;
    const Plain *plain = context;
    (void)rays;
    for (size_t i = 0; i < count; i++)
        wrong += hits[i].id != plain->expected[i];
    return wrong;
}

static void rays_at_ten_million_coplanar_triangles_meet_the_right_one_t15(void **state)
{
    Stage stage;
    Trial trial;
    Error error = {0};
    char details[96];
    Random random = {15};
    const size_t count = 100000;
    Plain plain = {.cells = tier() < 2 ? 256 : 2236};
    plain.expected = memory_raw(count, sizeof *plain.expected, &error);
    require(plain.expected != NULL, &error);
    const double side = plain.cells;
    Scene scene =
        shape_scene(shape_plane(vec3(0, 0, 0), vec3(side, 0, 0), vec3(0, side, 0), plain.cells));
    stage_make(&stage, &scene, TREE_SAH);
    scene_free(&scene);
    plain.unit = stage.normalization.scale;
    TestRay *rays = aim_make_rays(count);
    for (size_t i = 0; i < count; i++)
        rays[i] = random_ray(&plain, i, &random);
    trial_open(&trial, "T-15", *state, &stage);
    snprintf(details, sizeof details, "triangles=%zu depth=%u megabytes=%zu", stage.triangles.count,
             stage.bvh.depth, flat_size(&stage.flat) >> 20);
    const size_t wrong =
        trial_judge(&trial, details, rays, count, &(Judgment){count_others, &plain});
    trial_close(&trial);
    stage_free(&stage);
    free(rays);
    free(plain.expected);
    assert_int_equal(wrong, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_at_ten_million_coplanar_triangles_meet_the_right_one_t15),
    };
    return cmocka_run_group_tests(tests, ray_batch_setup, ray_batch_teardown);
}
