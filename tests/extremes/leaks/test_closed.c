// SPDX-License-Identifier: MIT
// Every ray that starts inside a closed shape must hit the shape, even at its edges and vertices.
// The shapes are centered at a distance of about 2^exponent from the origin. The rays start in a
// cube of side 2 around the center.
#include "support/rig.h"
#include "support/shapes.h"

static const char *const aim_names[AIM_KINDS] = {"random", "edges", "vertices", "vertices_exactly"};

// A set of aims (rays.h) is a bit mask: AIM(aim) is the bit of `aim`. AIMS selects random rays,
// rays at edges, and rays at vertices with rounded directions.
#define AIM(aim) (1u << (aim))
#define AIMS     (AIM(AIM_RANDOM) | AIM(AIM_EDGES) | AIM(AIM_VERTICES))

typedef struct {
    const char *test;
    const char *label; // the first part of each case's details
    uint64_t seed;     // for exponent 0
    unsigned aims;     // bits of AIM
    size_t rays;       // per aim
} ClosedTest;

// Traces rays that start around shape_center(exponent), the center of the closed scene, and reports
// how many rays miss.
static void judge_aims(Rig *rig, int exponent, const ClosedTest *test)
{
    Random random = {test->seed + (uint64_t)exponent};
    FREED_BY(rays_free) const Rays rays = rays_make(test->rays);
    const Room room = room_inside(&rig->stage, shape_center(exponent), 1);
    rig->test = test->test;
    for (Aim aim = 0; aim < AIM_KINDS; aim++) {
        if ((test->aims & AIM(aim)) == 0)
            continue;
        rays_aim(rays, aim, &room, &rig->stage.triangles, &random);
        outcome_report(rig_judge(rig, rays, judge_misses, NULL), "%sk=%d aim=%s", test->label,
                       exponent, aim_names[aim]);
    }
}

// Judges the scene by one test, and frees the scene.
static void judge_closed(RayBatch *batch, Scene scene, int exponent, const ClosedTest *test)
{
    FREED_BY(rig_close) Rig rig = rig_open(test->test, batch, scene);
    judge_aims(&rig, exponent, test);
}

// Returns a sphere around shape_center(exponent). The sphere has 200 rings below exponent 20. From
// exponent 20 on, it has 20 rings, because floats are too far apart for more.
static Scene closed_sphere(int exponent)
{
    return shape_scene(shape_sphere(exponent < 20 ? 200 : 20, shape_center(exponent)));
}

// Three tests share the sphere, because building its trees takes longer than tracing the rays.
static void judge_sphere(RayBatch *batch, int exponent)
{
    const unsigned vertices = AIM(AIM_VERTICES) | AIM(AIM_VERTICES_EXACTLY);
    const ClosedTest tests[] = {
        {"T-01", "", 1000, AIM(AIM_RANDOM), tier_size(10000, 1000000)},
        {"T-02", "", 2000, AIM(AIM_EDGES), tier_size(10000, 100000)},
        {"T-03", "", 3000, vertices, tier_size(10000, 100000)},
    };
    FREED_BY(rig_close) Rig rig = rig_open(tests[0].test, batch, closed_sphere(exponent));
    for (size_t i = 0; i < COUNT(tests); i++)
        judge_aims(&rig, exponent, &tests[i]);
}

// At tier 0, judges spheres of exponents 0, 10 and 18. At higher tiers, judges exponents 0 to 23.
EXTREME(no_ray_leaves_a_closed_sphere_t01_t02_t03)
{
    for (int exponent = 0; exponent < 24; exponent++)
        if (tier() > 0 || exponent == 0 || exponent == 10 || exponent == 18)
            judge_sphere(*state, exponent);
}

EXTREME(a_hundred_million_random_rays_never_leave_a_closed_sphere_t01)
{
    Outcome sum = {.test = "T-01"};
    Random random = {100};
    if (tier() < 2)
        return;
    FREED_BY(rays_free) const Rays rays = rays_make(1000000);
    FREED_BY(rig_close) Rig rig = rig_open("T-01", *state, closed_sphere(10));
    const Room room = room_inside(&rig.stage, shape_center(10), 1);
    peers_close(&rig.peers);
    for (int batch = 0; batch < 100; batch++) {
        rays_aim(rays, AIM_RANDOM, &room, &rig.stage.triangles, &random);
        outcome_add(&sum, rig_judge(&rig, rays, judge_misses, NULL));
    }
    outcome_report(sum, "soak k=10");
}

EXTREME(no_ray_leaves_a_closed_bumpy_sphere_t04)
{
    for (int exponent = 0; exponent <= 20; exponent += tier() == 0 ? 10 : 5) {
        Random random = {(uint64_t)(4000 + exponent)};
        Scene scene = shape_scene(shape_bumpy(&random, shape_center(exponent)));
        const ClosedTest test = {"T-04", "", random - (uint64_t)exponent, AIMS,
                                 tier_size(10000, 100000)};
        judge_closed(*state, scene, exponent, &test);
    }
}

// Far from the origin, many triangles of a sphere have two corners that rounding makes equal.
static void judge_crushed_sphere(RayBatch *batch, int exponent, uint32_t rings)
{
    char label[64];
    Mesh sphere = shape_sphere(rings, shape_center(exponent));
    Error error = {0};
    assert_true(mesh_drop_triangles(&sphere, &error));
    snprintf(label, sizeof label, "rings=%u dropped=%zu ", rings, sphere.dropped.count);
    const ClosedTest test = {"T-11", label, 1100, AIM(AIM_EDGES) | AIM(AIM_VERTICES),
                             tier_size(10000, 150000)};
    judge_closed(batch, shape_scene(sphere), exponent, &test);
}

EXTREME(dropping_triangles_opens_no_seam_t11)
{
    for (int exponent = 19; exponent <= 23; exponent++)
        judge_crushed_sphere(*state, exponent, 20);
    for (int exponent = 19; exponent <= 21; exponent++)
        judge_crushed_sphere(*state, exponent, 60);
}

static void judge_device(const char *label, const char *kernels, const char *options)
{
    RayBatch batch;
    const ClosedTest test = {"T-65", label, 6500, AIMS, tier_size(10000, 100000)};
    ray_batch_open(&batch, kernels, options);
    for (int exponent = 0; exponent <= 18; exponent += 6)
        judge_closed(&batch, closed_sphere(exponent), exponent, &test);
    ray_batch_close(&batch);
}

EXTREME(devices_that_can_do_less_leak_as_little_t65)
{
    if (tier() == 0)
        return;
    unsetenv("CLRT_TEST_PEERS"); // Embree does not run on these devices
    judge_device("device=no_denormals ", NULL, "-cl-denorms-are-zero");
    judge_device("device=coarse_division ", COARSE_KERNELS, NULL);
    judge_device("device=coarse_division_no_denormals ", COARSE_KERNELS, "-cl-denorms-are-zero");
}

FIXTURES(ray_batch_setup, ray_batch_teardown)
