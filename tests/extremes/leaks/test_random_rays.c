// SPDX-License-Identifier: MIT
// Random rays inside closed spheres ever farther from the origin: a miss is a hole.
#include "support/aim.h"
#include "support/check.h"
#include "support/sphere_case.h"
#include "support/tier.h"

#include <stdlib.h>

static void random_rays_never_leave_a_closed_sphere_t01(void **state)
{
    size_t misses = 0;
    const size_t count = tier_size(10000, 1000000);
    TestRay *rays = aim_make_rays(count);
    for (int exponent = 0; exponent < SPHERE_EXPONENTS; exponent++) {
        char details[32];
        SphereCase sphere;
        Random random = {(uint64_t)(1000 + exponent)};
        if (!sphere_case_is_wanted(exponent))
            continue;
        sphere_case_make(&sphere, "T-01", *state, exponent);
        aim_randomly(rays, count, &sphere.room, &random);
        snprintf(details, sizeof details, "k=%d", exponent);
        misses += trial_misses(&sphere.trial, details, rays, count);
        sphere_case_free(&sphere);
    }
    free(rays);
    assert_int_equal(misses, 0);
}

// A hundred times as many at the scale of ordinary scenes.
static void a_hundred_million_random_rays_never_leave_a_closed_sphere_t01(void **state)
{
    size_t misses = 0;
    const size_t count = 1000000;
    SphereCase sphere;
    Random random = {100};
    Fails fails = {0};
    const size_t batches = tier() < 2 ? 0 : 100;
    if (batches == 0)
        return;
    TestRay *rays = aim_make_rays(count);
    sphere_case_make(&sphere, "T-01", *state, 10);
    peers_close(&sphere.trial.peers);
    for (size_t batch = 0; batch < batches; batch++) {
        aim_randomly(rays, count, &sphere.room, &random);
        const Fails more = trial_fails(&sphere.trial, rays, count, &judgment_misses);
        fails_add(&fails, &more);
    }
    misses = report_fails("T-01", "soak k=10", batches * count, &fails);
    sphere_case_free(&sphere);
    free(rays);
    assert_int_equal(misses, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_rays_never_leave_a_closed_sphere_t01),
        cmocka_unit_test(a_hundred_million_random_rays_never_leave_a_closed_sphere_t01),
    };
    return cmocka_run_group_tests(tests, ray_batch_setup, ray_batch_teardown);
}
