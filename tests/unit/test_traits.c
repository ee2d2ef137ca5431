// SPDX-License-Identifier: MIT
// Tests that a scene's contents determine its kernel features.
#include "accel/traits.h"

#include "unit/cmocka_all.h"

static Material materials[2];
static SphereData spheres[1];

TEST(only_materials_in_use_count)
{
    FlatScene flat = {
        .materials = materials, .material_count = 2, .spheres = spheres, .sphere_count = 1};
    materials[1] = (Material){.shader = SHADER_BLINN_PHONG, .reflectivity = 0.5f};
    spheres[0].material = 0;
    assert_false(traits_of(&flat, false).mirrors);
    assert_false(traits_of(&flat, false).shaded);
    spheres[0].material = 1;
    assert_true(traits_of(&flat, false).mirrors);
    assert_true(traits_of(&flat, false).shaded);
    assert_true(traits_of(&flat, false).spheres);
    assert_false(traits_of(&flat, false).triangles);
}

TEST(traits_become_compiler_options)
{
    char options[TRAITS_OPTIONS_SIZE];
    const SceneTraits traits = {.spheres = true, .mirrors = true, .statistics = true};
    traits_write_options(&traits, options);
    assert_string_equal(options, "-DCLRT_SPHERES=1 -DCLRT_TRIANGLES=0 -DCLRT_BVH=0 "
                                 "-DCLRT_MIRRORS=1 -DCLRT_SHADED=0 -DCLRT_STATISTICS=1");
}
