// SPDX-License-Identifier: MIT
// Tests how many levels of rays a scene needs.
#include "scene/scene.h"
#include "unit/cmocka_all.h"

#include <math.h>

// Returns a scene with a sphere of each reflectivity.
static Scene scene_of(const float reflectivities[], size_t count)
{
    Scene scene = {0};
    Error error = {0};
    for (uint32_t i = 0; i < count; i++) {
        const Material material = {.reflectivity = reflectivities[i]};
        const Sphere sphere = {.radius = 1, .material = i};
        assert_true(array_push(&scene.materials, material, &error));
        assert_true(array_push(&scene.spheres, sphere, &error));
    }
    return scene;
}

TEST(the_bound_is_the_largest_weight_that_is_left)
{
    FREED_BY(scene_free) Scene scene = scene_of((const float[]){0.25f, 0.5f, 0}, 3);
    assert_true(truncation_bound(&scene, 0) == 1);
    assert_true(truncation_bound(&scene, 3) == 0.125);
}

TEST(the_level_is_the_first_within_the_bound)
{
    FREED_BY(scene_free) Scene scene = scene_of((const float[]){0.5f}, 1);
    for (uint32_t level = 0; level < 30; level++) {
        assert_int_equal(truncation_level(&scene, ldexp(1, -(int)level)), level);
        assert_int_equal(truncation_level(&scene, ldexp(0.99, -(int)level)), level + 1);
    }
}

TEST(without_mirrors_one_level_is_exact)
{
    Scene scene = scene_of((const float[]){0}, 1), empty = {0};
    assert_int_equal(truncation_level(&scene, 1e-30), 1);
    assert_int_equal(truncation_level(&empty, 1e-30), 1);
    assert_true(truncation_bound(&scene, 1) == 0);
    scene_free(&scene);
}

TEST(perfect_mirrors_take_all_levels)
{
    FREED_BY(scene_free) Scene scene = scene_of((const float[]){1}, 1);
    assert_int_equal(truncation_level(&scene, 0.5), MAX_LEVEL_LIMIT);
    assert_true(truncation_bound(&scene, MAX_LEVEL_LIMIT) == 1);
}

TEST(materials_that_nothing_uses_do_not_count)
{
    Error error = {0};
    FREED_BY(scene_free) Scene scene = scene_of((const float[]){0.25f}, 1);
    assert_true(array_push(&scene.materials, (Material){.reflectivity = 1}, &error));
    assert_true(truncation_bound(&scene, 2) == 0.0625);
}
