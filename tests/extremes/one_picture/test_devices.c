// SPDX-License-Identifier: MIT
// Devices without denormals, exact division or fp64 leak no rays either. Another device draws the
// same picture.
#include "support/closed.h"
#include "support/varied_scene.h"

#include "kernel/doubles.h"

static void judge_device(const char *label, const char *kernels, const char *options)
{
    RayBatch batch;
    const ClosedTest test = {"T-65", label, 6500, CLOSED_AIMS, tier_size(10000, 100000)};
    ray_batch_open(&batch, kernels, options);
    for (int exponent = 0; exponent <= 18; exponent += 6)
        closed_judge(&batch, closed_sphere(exponent), exponent, &test);
    ray_batch_close(&batch);
}

static void devices_that_can_do_less_leak_as_little_t65(void **state)
{
    (void)state;
    unsetenv("CLRT_TEST_PEERS"); // Embree does not run on these devices
    judge_device("device=no_denormals ", NULL, "-cl-denorms-are-zero");
    judge_device("device=coarse_division ", COARSE_KERNELS, NULL);
    judge_device("device=coarse_division_no_denormals ", COARSE_KERNELS, "-cl-denorms-are-zero");
    // Devices without fp64 run the same kernels, which use none.
    outcome_report(outcome_of("T-65", 1, doubles_without_fp64(kernel_source)), "fp64=unused");
}

static void another_device_draws_the_same_picture_t52(void **state)
{
    Error error = {0};
    Studio *studio = NULL, other = {0};
    const PictureSettings settings = picture_settings(64);
    (void)state;
    if (!device_open(&other.device, "gpu", &error)) {
        outcome_report(outcome_of("T-52", 0, 0), "skipped: this machine has no OpenCL GPU");
        return;
    }
    picture_setup((void **)&studio);
    other.cache = studio->cache;
    Framebuffer usual = varied_picture(studio, &settings);
    outcome_report(picture_compare("T-52", &usual, varied_picture(&other, &settings)),
                   "device=gpu");
    framebuffer_free(&usual);
    device_close(&other.device);
    picture_teardown((void **)&studio);
}

RUN_TESTS(NULL, NULL, EXTREME(devices_that_can_do_less_leak_as_little_t65),
          EXTREME(another_device_draws_the_same_picture_t52))
