// SPDX-License-Identifier: MIT
// Tests the kernel features that a scene needs.
#include "unit/cmocka_all.h"

#include "accel/traits.h"

static Material materials[2];
static SphereData spheres[1];

TEST(only_materials_in_use_count)
{
    FlatScene flat = {.materials = materials,
                      .material_count = 2,
                      .spheres = spheres,
                      .sphere_count = 1,
                      .sphere_entries = 1};
    materials[1] = (Material){.shader = SHADER_BLINN_PHONG, .reflectivity = 0.5f};
    spheres[0].material = 0;
    assert_false(traits_of(&flat, false).mirrors);
    assert_false(traits_of(&flat, false).shaded);
    spheres[0].material = 1;
    assert_true(traits_of(&flat, false).mirrors);
    assert_true(traits_of(&flat, false).shaded);
    assert_true(traits_of(&flat, false).spheres);
    assert_false(traits_of(&flat, false).glass);
    materials[1] = (Material){.shader = SHADER_GLASS, .reflectivity = 1};
    assert_true(traits_of(&flat, false).glass && traits_of(&flat, false).mirrors);
    assert_false(traits_of(&flat, false).shaded);
    assert_false(traits_of(&flat, false).triangles);
}

TEST(general_programs_have_rare_traits_only_if_needed)
{
    const SceneTraits plain = traits_general((SceneTraits){0});
    assert_true(plain.mirrors && plain.colors);
    assert_false(plain.checkers || plain.glass || plain.statistics);
    const SceneTraits checkers = traits_general((SceneTraits){.checkers = true});
    assert_true(checkers.checkers && !checkers.glass);
    const SceneTraits glass = traits_general((SceneTraits){.glass = true});
    assert_true(glass.checkers && glass.glass);
}

TEST(traits_become_compiler_options)
{
    char options[TRAITS_OPTIONS_SIZE];
    const SceneTraits traits = {.spheres = true, .mirrors = true, .statistics = true};
    traits_write_options(&traits, options);
    assert_string_equal(options, "-DCLRT_SPHERES=1 -DCLRT_TRIANGLES=0 -DCLRT_BVH=0 "
                                 "-DCLRT_SHADED=0 -DCLRT_MIRRORS=1 -DCLRT_COLORS=0 "
                                 "-DCLRT_CHECKERS=0 -DCLRT_GLASS=0 -DCLRT_STATISTICS=1");
}
