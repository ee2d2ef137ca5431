// SPDX-License-Identifier: MIT
// Random rays inside closed spheres ever farther from the origin: a miss is a hole.
#include "support/aim.h"
#include "support/check.h"
#include "support/sphere_case.h"

#include <stdlib.h>

#define RAYS 1000000

static void random_rays_never_leave_a_closed_sphere_t01(void **state)
{
    RayBatch *batch = *state;
    size_t misses = 0;
    const size_t count = RAYS / aim_share();
    TestRay *rays = aim_make_rays(count);
    for (int exponent = 0; exponent < SPHERE_EXPONENTS; exponent++) {
        char details[32];
        SphereCase sphere;
        Random random = {(uint64_t)(1000 + exponent)};
        sphere_case_make(&sphere, batch, exponent);
        aim_randomly(rays, count, &sphere.room, &random);
        snprintf(details, sizeof details, "k=%d", exponent);
        misses += report_case("T-01", details, count, aim_count_misses(batch, rays, count));
        sphere_case_free(&sphere);
    }
    free(rays);
    assert_int_equal(misses, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_rays_never_leave_a_closed_sphere_t01),
    };
    return cmocka_run_group_tests(tests, ray_batch_setup, ray_batch_teardown);
}
