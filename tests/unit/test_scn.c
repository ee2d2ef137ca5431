// SPDX-License-Identifier: MIT
// Tests every statement of scene text.
#include "unit/parsed.h"

#include <math.h>

TEST(an_empty_scene_has_the_courses_constants)
{
    FREED_BY(scene_free) Scene scene = parsed("");
    assert_int_equal(scene.width, 512);
    assert_int_equal(scene.height, 512);
    assert_int_equal(scene.max_level, 3);
    assert_true(scene.ambient == 0.05);
    assert_true(scene.background.x == 1 && scene.background.y == 1 && scene.background.z == 1);
    assert_int_equal(scene.viewpoints.count, 6);
}

// The expected numbers come from the course's framework, which prints six decimals.
TEST(the_six_viewpoints_are_the_courses)
{
    static const double eyes[6][3] = {
        {4.512768, 2.104338, 4.178119},  {1.528549, -0.900384, 0.923497},
        {0.846686, 0.638024, 3.649116},  {4.291287, 0, -4.474913},
        {-2.275540, 0.287467, 1.606014}, {0.165138, 0.084142, 1.084274}};
    FREED_BY(scene_free) Scene scene = parsed("");
    for (int view = 0; view < 6; view++) {
        const Vec3 eye = scene.viewpoints.data[view].eye;
        assert_true(fabs(eye.x - eyes[view][0]) < 1e-6);
        assert_true(fabs(eye.y - eyes[view][1]) < 1e-6);
        assert_true(fabs(eye.z - eyes[view][2]) < 1e-6);
    }
}

TEST(spheres_take_the_material_before_them)
{
    FREED_BY(scene_free)
    Scene scene =
        parsed("sphere 0 0 0 1\nmaterial 2\nsphere 1 2 3 .5\nmaterial 17\nsphere 0 0 0 1\n"
               "material 2\nmaterial own\nsphere 0 0 0 1\n"
               "define own matte\nmaterial own\nsphere 0 0 0 1");
    // Spheres have no file with materials, so `own` is the silhouette unless it is defined.
    static const uint32_t materials[] = {0, 2, 0, 0, 4};
    assert_int_equal(scene.spheres.count, 5);
    for (size_t i = 0; i < 5; i++)
        assert_int_equal(scene.spheres.data[i].material, materials[i]);
    assert_true(scene.spheres.data[1].center.z == 3 && scene.spheres.data[1].radius == 0.5);
    assert_int_equal(scene.materials.data[3].shader, SHADER_MATTE);
    assert_true(scene.materials.data[3].reflectivity == 0.25f);
}

TEST(the_points_of_an_area_light_are_evenly_spaced_and_share_its_intensity)
{
    FREED_BY(scene_free)
    Scene scene = parsed("light 1 2 3 8 1 0.5 0 area 4 0 0 0 0 16 2\n"
                         "light 1 2 3 2 1 0.5 0 area 4 0 0 0 0 16 1");
    static const double x[] = {-0.5, 1.5, 0.5, 2.5, 1}, z[] = {-3, 1, 5, 9, 3};
    assert_int_equal(scene.lights.count, 5);
    for (int i = 0; i < 5; i++) {
        const Light *light = &scene.lights.data[i];
        assert_true(light->position.x == x[i] && light->position.y == 2 &&
                    light->position.z == z[i]);
        assert_true(light->intensity == 2 && light->color.y == 0.5);
    }
}

TEST(suns_are_lights_with_a_direction)
{
    FREED_BY(scene_free) Scene scene = parsed("light 1 2 3 0.5\nsun 0 -3 4 0.5 0.25 1 0");
    const Light *sun = &scene.lights.data[1];
    assert_int_equal(scene.lights.count, 2);
    assert_true(!scene.lights.data[0].is_sun && sun->is_sun);
    assert_true(sun->position.y == -3 && sun->intensity == 0.5 && sun->color.x == 0.25);
}

TEST(lights_are_white_or_have_a_color_and_the_last_line_needs_no_line_end)
{
    FREED_BY(scene_free) Scene scene = parsed("light 1 2 3 0.5\nlight 1 2 3 0.5 0.25 1 0");
    const Vec3 white = scene.lights.data[0].color, color = scene.lights.data[1].color;
    assert_int_equal(scene.lights.count, 2);
    assert_true(scene.lights.data[0].position.y == 2 && scene.lights.data[0].intensity == 0.5);
    assert_true(white.x == 1 && white.y == 1 && white.z == 1);
    assert_true(color.x == 0.25 && color.y == 1 && color.z == 0);
}

TEST(a_definition_starts_from_its_kind)
{
    FREED_BY(scene_free)
    Scene scene = parsed("define gold blinn_phong diffuse 1 .8 .2 shininess 200 reflectivity .3\n"
                         "define wax matte\nmaterial wax\nsphere 0 0 0 1\nmaterial gold\n"
                         "sphere 0 0 0 1");
    const Material *gold = &scene.materials.data[scene.spheres.data[1].material];
    assert_true(gold->diffuse[2] == 0.2f && gold->kd == 0.8f && gold->ks == 0.5f);
    assert_int_equal(gold->exponent, 200);
    assert_true(gold->reflectivity == 0.3f);
    const Material *wax = &scene.materials.data[scene.spheres.data[0].material];
    assert_true(wax->diffuse[0] == 1 && wax->kd == 1 && wax->reflectivity == 0);
}

TEST(a_checker_has_a_size_and_two_colors)
{
    FREED_BY(scene_free)
    Scene scene = parsed("define a matte checker 2.5 0.1 0.2 0.3 1 0 1 diffuse 0 1 0");
    const Material *material = &scene.materials.data[COURSE_MATERIALS];
    const float colors[2][3] = {{0.1f, 0.2f, 0.3f}, {1, 0, 1}};
    assert_true(material->check_size == 2.5f && material->diffuse[0] == 0);
    assert_memory_equal(material->checks, colors, sizeof colors);
}

TEST(glass_has_a_color_and_an_index_of_refraction)
{
    FREED_BY(scene_free)
    Scene scene = parsed("define plain glass\ndefine green glass color 0.5 1 0.25 ior 2.4\n"
                         "max_level 9\nmaterial green\nsphere 0 0 0 1");
    const Material *plain = &scene.materials.data[COURSE_MATERIALS], *green = plain + 1;
    assert_int_equal(green->shader, SHADER_GLASS);
    assert_true(plain->ior == 1.5f && plain->diffuse[1] == 1 && plain->diffuse[2] == 1);
    assert_true(green->ior == 2.4f && green->diffuse[0] == 0.5f);
    assert_true(green->reflectivity == 1);
    // Glass needs no light. Glass may absorb no light, so no max_level bounds the error.
    assert_null(scene_missing(&scene).kind);
    assert_true(truncation_bound(&scene, 9) == 1);
    assert_int_equal(truncation_level(&scene, 0.01), GLASS_LEVELS);
}

TEST(only_small_integer_shininess_goes_by_squaring)
{
    Scene scene =
        parsed("define a blinn_phong shininess 30.5\ndefine b blinn_phong shininess 2000\n"
               "define c blinn_phong shininess 1024");
    assert_int_equal(scene.materials.data[4].exponent, UINT32_MAX);
    assert_int_equal(scene.materials.data[5].exponent, UINT32_MAX);
    assert_int_equal(scene.materials.data[6].exponent, 1024);
    scene_free(&scene);
}

TEST(cameras_are_viewpoints_in_order_and_up_is_for_those_that_follow)
{
    FREED_BY(scene_free)
    Scene scene = parsed("camera 1 0 0 0 0 0 30\nup 0 1 0\ncamera 0 0 9 0 0 0 60");
    assert_int_equal(scene.viewpoints.count, 2);
    assert_true(scene.viewpoints.data[0].up.z == 1);
    assert_true(scene.viewpoints.data[1].up.y == 1 && scene.viewpoints.data[1].fov_degrees == 60);
}

TEST(size_background_ambient_and_level_are_taken)
{
    FREED_BY(scene_free)
    Scene scene = parsed("size 640 480\nbackground 0 .5 1\nambient 0\nmax_level 9");
    assert_int_equal(scene.width, 640);
    assert_int_equal(scene.height, 480);
    assert_true(scene.background.y == 0.5 && scene.ambient == 0);
    assert_int_equal(scene.max_level, 9);
}

TEST(material_own_shows_colors_and_may_name_the_material_of_files_without_one)
{
    FREED_BY(scene_free)
    Scene scene = parsed("define gold blinn_phong\ndefine own-er matte\n"
                         "mesh ../tests/image/painted.ply\nmesh cube.ply\n"
                         "material own gold\nmesh ../tests/image/painted.ply\nmesh cube.ply\n"
                         "sphere 0 0 0 1\nmaterial own 3\nply_file ../tests/image/painted.ply\n"
                         "material gold\nmesh ../tests/image/painted.ply\n");
    static const uint32_t materials[] = {COURSE_MATTE, 0, 4, 4, 3, 4};
    static const bool colored[] = {true, false, true, false, true, false};
    assert_int_equal(scene.objects.count, 6);
    for (size_t i = 0; i < 6; i++) {
        assert_int_equal(scene.objects.data[i].material, materials[i]);
        assert_true((scene.objects.data[i].mesh.colors != NULL) == colored[i]);
    }
    assert_int_equal(scene.spheres.data[0].material, 4);
}

TEST(sides_and_normals_are_for_the_objects_that_follow)
{
    FREED_BY(scene_free)
    Scene scene = parsed("ply_file cube.ply\nsides two\nnormals flat\nmesh cube.ply\n");
    assert_false(scene.objects.data[0].two_sided);
    assert_non_null(scene.objects.data[0].mesh.normals);
    assert_true(scene.objects.data[1].two_sided);
    assert_null(scene.objects.data[1].mesh.normals);
}

// A rotation by 90 degrees about z maps x to y exactly, except for one rounding of the axis's
// length.
TEST(transforms_apply_in_the_order_written)
{
    FREED_BY(scene_free)
    Scene scene = parsed("mesh cube.ply\n"
                         "mesh cube.ply scale 2 rotate 0 0 5 90 translate 10 0 0\n"
                         "mesh cube.ply translate 10 0 0 scale 2\n");
    const double *plain = scene.objects.data[0].mesh.positions[0];
    const double *turned = scene.objects.data[1].mesh.positions[0];
    const double *moved = scene.objects.data[2].mesh.positions[0];
    assert_true(fabs(turned[0] - (10 - 2 * plain[1])) < 1e-14);
    assert_true(fabs(turned[1] - 2 * plain[0]) < 1e-14);
    assert_true(fabs(moved[0] - 2 * (plain[0] + 10)) < 1e-14);
}

TEST(different_scenes_have_different_hashes)
{
    FREED_BY(scene_free) Scene one = parsed("sphere 0 0 0 1"), same = parsed("sphere 0 0 0 1");
    FREED_BY(scene_free) Scene other = parsed("sphere 0 0 0 2");
    assert_memory_equal(one.hash, same.hash, sizeof one.hash);
    assert_memory_not_equal(one.hash, other.hash, sizeof one.hash);
}

TEST(the_longest_normals_can_be_rotated)
{
    FREED_BY(scene_free) Scene scene = parsed("mesh ../tests/unit/huge_normal.ply rotate 1 0 0 20");
    const float *normal = scene.objects.data[0].mesh.normals[0];
    // In the file, y equals z. Rotation by 20 degrees about x multiplies z by cosine plus sine.
    assert_true(isfinite(normal[2]));
    assert_true(fabsf(normal[2] / normal[0] - 1.2817128f) < 1e-6f);
}

TEST(a_scene_names_the_files_it_was_read_from)
{
    FREED_BY(scene_free) Scene scene;
    Error error = {0};
    assert_true(
        scn_load(&scene, CLRT_SOURCE_FOLDER "/scenes/simple.scn", &(SceneLoadOptions){0}, &error));
    assert_int_equal(scene.inputs.count, 1 + scene.objects.count);
    assert_string_equal(scene.inputs.data[0], CLRT_SOURCE_FOLDER "/scenes/plateau.ply");
    assert_string_equal(scene.inputs.data[scene.inputs.count - 1],
                        CLRT_SOURCE_FOLDER "/scenes/simple.scn");
}

TEST(a_camera_may_have_a_width)
{
    FREED_BY(scene_free)
    Scene scene = parsed("camera 1 2 3 4 5 6 30\ncamera 1 2 3 4 5 6 30 60");
    assert_true(scene.viewpoints.data[0].width_degrees == 0);
    assert_true(scene.viewpoints.data[1].width_degrees == 60);
}

TEST(an_orthographic_camera_has_a_height_and_may_have_a_width)
{
    FREED_BY(scene_free)
    Scene scene = parsed("camera 1 2 3 4 5 6 orthographic 7\ncamera 1 2 3 4 5 6 orthographic 7 8");
    assert_true(scene.viewpoints.data[0].height == 7 && scene.viewpoints.data[0].width == 0);
    assert_true(scene.viewpoints.data[1].height == 7 && scene.viewpoints.data[1].width == 8);
}

TEST(a_scene_distinguishes_the_courses_cameras_from_its_own)
{
    FREED_BY(scene_free) Scene plain = parsed(""), own = parsed("camera 1 2 3 4 5 6 30");
    assert_true(plain.has_course_views);
    assert_false(own.has_course_views);
}
