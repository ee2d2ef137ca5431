// SPDX-License-Identifier: MIT
// Devices that can do less - no denormals, division good to 2.5 ulp, no fp64 - leak as little, and
// another device draws the same picture.
#include "support/aim.h"
#include "support/check.h"
#include "support/picture.h"
#include "support/sphere_case.h"
#include "support/tier.h"
#include "support/varied_scene.h"

#include "device/program.h"
#include "kernel/doubles.h"

#include <stdlib.h>

static size_t misses_at(RayBatch *batch, const char *device, int exponent)
{
    char details[80];
    SphereCase sphere;
    size_t misses = 0;
    Random random = {(uint64_t)(6500 + exponent)};
    const size_t count = tier_size(10000, 100000);
    TestRay *rays = aim_make_rays(count);
    sphere_case_make(&sphere, "T-65", batch, exponent);
    peers_close(&sphere.trial.peers);
    const Triangles *triangles = &sphere.stage.triangles;
    aim_randomly(rays, count, &sphere.room, &random);
    snprintf(details, sizeof details, "device=%s k=%d aim=random", device, exponent);
    misses += trial_misses(&sphere.trial, details, rays, count);
    aim_at_edges(rays, count, &sphere.room, triangles, &random);
    snprintf(details, sizeof details, "device=%s k=%d aim=edges", device, exponent);
    misses += trial_misses(&sphere.trial, details, rays, count);
    aim_at_vertices(rays, count, &sphere.room, triangles, &random);
    snprintf(details, sizeof details, "device=%s k=%d aim=vertices", device, exponent);
    misses += trial_misses(&sphere.trial, details, rays, count);
    sphere_case_free(&sphere);
    free(rays);
    return misses;
}

static size_t misses_on(const char *device, const char *kernels, const char *options)
{
    RayBatch batch;
    size_t misses = 0;
    ray_batch_open(&batch, kernels, options);
    for (int exponent = 0; exponent <= 18; exponent += 6)
        misses += misses_at(&batch, device, exponent);
    ray_batch_close(&batch);
    return misses;
}

static void devices_that_can_do_less_leak_as_little_t65(void **state)
{
    (void)state;
    size_t misses = misses_on("no_denormals", NULL, "-cl-denorms-are-zero");
    misses += misses_on("coarse_division", COARSE_KERNELS, NULL);
    misses += misses_on("coarse_division_no_denormals", COARSE_KERNELS, "-cl-denorms-are-zero");
    // Nothing asks for fp64, so that devices without it need no other kernels.
    misses += report_case("T-65", "fp64=unused", 1, doubles_without_fp64(kernel_source));
    assert_int_equal(misses, 0);
}

static void another_device_draws_the_same_picture_t52(void **state)
{
    Error error = {0};
    Studio *studio = NULL, other = {0};
    Framebuffer usual, foreign;
    (void)state;
    if (!device_open(&other.device, "gpu", &error)) {
        report_passed_over("T-52", "this machine has no GPU that OpenCL knows");
        return;
    }
    picture_setup((void **)&studio);
    other.cache = studio->cache;
    const PictureSettings settings = picture_settings();
    Scene scene = varied_scene();
    picture_draw(&usual, studio, &scene, &settings);
    picture_draw(&foreign, &other, &scene, &settings);
    const size_t differences = picture_count_differences(&usual, &foreign);
    const size_t pixels = (size_t)usual.width * usual.height;
    framebuffer_free(&usual);
    framebuffer_free(&foreign);
    scene_free(&scene);
    device_close(&other.device);
    picture_teardown((void **)&studio);
    assert_int_equal(report_case("T-52", "device=gpu", pixels, differences), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(devices_that_can_do_less_leak_as_little_t65),
        cmocka_unit_test(another_device_draws_the_same_picture_t52),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
