// SPDX-License-Identifier: MIT
// Ten million triangles in a plane, on a lattice. All steps of these rays are exact in float, so
// they must hit the triangle at their target, also at grazing angles.
#include "support/rig.h"
#include "support/shapes.h"

// The plane is [0, cells]^2 in scene coordinates.
typedef struct {
    uint32_t cells;
    double unit;        // a cell's side in normalized coordinates
    uint32_t *expected; // ids, by ray
} Plain;

// Returns the id of the triangle at a point. The two triangles of a cell share its diagonal.
static uint32_t triangle_at(const Plain *plain, double x, double y)
{
    const double column = floor(x), row = floor(y);
    const uint32_t cell = (uint32_t)row * plain->cells + (uint32_t)column;
    return 2 * cell + (x - column > y - row ? 0 : 1);
}

// Returns an odd number of sixteenths, which is on no line of the lattice.
static double between_lines(const Plain *plain, Random *random)
{
    return (2 * random_below(random, 8 * plain->cells) + 1) / 16.0;
}

// Returns a ray that starts `count` times `along` before a target in the plane. Vectors are in
// cells.
static TestRay ray_to(const Plain *plain, Vec3 target, Vec3 along, double count)
{
    const double half = plain->cells / 2.0;
    const Vec3 start = vec3_sub(vec3_sub(target, vec3(half, half, 0)), vec3_scale(along, count));
    const Vec3 origin = vec3_scale(start, plain->unit);
    const TestRay ray = ray_between(origin, vec3_add(origin, along));
    assert_memory_equal(&(Vec3[1]){vec3_of(ray.origin)}, &origin, sizeof origin);
    assert_memory_equal(&(Vec3[1]){vec3_of(ray.direction)}, &along, sizeof along);
    return ray;
}

// Returns a ray straight down, along a slope, or grazing at a millionth.
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

static bool judge_expected(void *context, const Traced *traced)
{
    return traced->hit->id != ((const Plain *)context)->expected[traced->index];
}

static void rays_at_ten_million_coplanar_triangles_meet_the_right_one_t15(void **state)
{
    Random random = {15};
    const Rays rays = rays_make(100000);
    Plain plain = {.cells = tier() < 2 ? 256 : 2236};
    const double side = plain.cells;
    Rig rig = rig_open(
        "T-15", *state,
        shape_scene(shape_plane(vec3(0, 0, 0), vec3(side, 0, 0), vec3(0, side, 0), plain.cells)));
    plain.unit = rig.stage.normalization.scale;
    plain.expected = require_memory(rays.count, sizeof *plain.expected);
    for (size_t i = 0; i < rays.count; i++)
        rays.data[i] = random_ray(&plain, i, &random);
    outcome_report(rig_judge(&rig, rays, judge_expected, &plain), "triangles=%zu depth=%u",
                   rig.stage.triangles.count, rig.stage.bvh.depth);
    rig_close(&rig);
    free(rays.data);
    free(plain.expected);
}

RUN_TESTS(ray_batch_setup, ray_batch_teardown,
          EXTREME(rays_at_ten_million_coplanar_triangles_meet_the_right_one_t15))
