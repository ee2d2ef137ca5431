// SPDX-License-Identifier: MIT
// Tests that an addition to a scene changes nothing if memory runs out.
#include "unit/cmocka_all.h"

#include "scene/scene.h"

// The linker replaces calls of array_reserve by __wrap_array_reserve.
static size_t elements_most = SIZE_MAX; // longer arrays find no memory
bool __real_array_reserve(void **memory, size_t *capacity, size_t count, size_t size, Error *error);
bool __wrap_array_reserve(void **memory, size_t *capacity, size_t count, size_t size, Error *error);

bool __wrap_array_reserve(void **memory, size_t *capacity, size_t count, size_t size, Error *error)
{
    return count > elements_most ? error_out_of_memory(error, count * size)
                                 : __real_array_reserve(memory, capacity, count, size, error);
}

TEST(an_area_light_is_added_as_a_whole_or_not_at_all)
{
    const Light light = {.intensity = 1};
    const LightArea area = {.sides = {{1, 0, 0}, {0, 1, 0}}, .cells = 3};
    Scene scene;
    Error error = {0};
    assert_true(scene_init(&scene, &error));
    assert_true(scene_add_area_light(&scene, &light, &area, &error));
    elements_most = 12;
    assert_false(scene_add_area_light(&scene, &light, &area, &error));
    assert_int_equal(scene.lights.count, 9);
    elements_most = SIZE_MAX;
    assert_true(scene_add_area_light(&scene, &light, &area, &error));
    assert_int_equal(scene.lights.count, 18);
    scene_free(&scene);
}
