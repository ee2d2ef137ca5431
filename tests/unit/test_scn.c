// SPDX-License-Identifier: MIT
// Tests every statement of scene text, and the exact messages of common faults.
#include "unit/parsed.h"

#include <math.h>

static void expect_error(const char *text, const char *message)
{
    Scene scene;
    Error error = {0};
    assert_false(parse(&scene, text, &error));
    const char *place = strstr(error.text, "inline.scn:");
    assert_non_null(place);
    assert_string_equal(place + strlen("inline.scn:"), message);
}

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

#define STATEMENT "; the statement is "
#define LIGHT     STATEMENT "'light X Y Z INTENSITY [R G B] [area UX UY UZ VX VY VZ N]'"
#define SUN       STATEMENT "'sun X Y Z INTENSITY [R G B]'"
#define SPHERE    STATEMENT "'sphere X Y Z RADIUS'"
#define DEFINE    STATEMENT "'define NAME silhouette|matte|blinn_phong|glass [PROPERTY VALUES]...'"
#define NORMALS   STATEMENT "'normals flat|smooth [DEGREES]'"
#define CAMERA                                                                                     \
    STATEMENT "'camera EYE_X EYE_Y EYE_Z AT_X AT_Y AT_Z FOV_DEGREES|orthographic HEIGHT [WIDTH]'"

TEST(faults_name_line_column_and_the_statement)
{
    static const char *const cases[][2] = {
        {"\nlight 1 2\n", "2:10: expected a number: found the end of the line" LIGHT},
        {"sphere 0 0 zero 1", "1:12: expected a number: found 'zero'" SPHERE},
        {"sphere 0 0 0 1 5", "1:16: expected nothing more: found '5'" SPHERE},
        {"sphere 0 0 0 0", "1:14: expected a number between 1e-30 and 1e+30: found '0'" SPHERE},
        {"sphere 0 0 0 3e-31",
         "1:14: expected a number between 1e-30 and 1e+30: found '3e-31'" SPHERE},
        {"light 0 0 0 nan", "1:13: expected a number: found 'nan'" LIGHT},
        {"light 1e39 0 0 1", "1:7: expected a number between -1e+30 and 1e+30: found '1e39'" LIGHT},
        {"light 0 0 0 1 1 0", "1:18: expected a number: found the end of the line" LIGHT},
        {"light 0 0 0 1 1 0 1.5", "1:19: expected a number between 0 and 1: found '1.5'" LIGHT},
        {"light 0 0 0 1 1 1 1 1", "1:21: expected nothing more: found '1'" LIGHT},
        {"light 0 0 0 1 area 1 0 0 0 1 0",
         "1:31: expected an integer between 1 and 16: found the end of the line" LIGHT},
        {"light 0 0 0 1 area 1 0 0 0 1 0 17",
         "1:32: expected an integer between 1 and 16: found '17'" LIGHT},
        {"sun 0 0 1 1 area 1 0 0 0 1 0 2", "1:13: expected nothing more: found 'area'" SUN},
        {"sun 0 0 0 1", "1:11: the direction of a sun must not be zero: found '1'" SUN},
        {"sun 0 0 1 1 2", "1:13: expected a number between 0 and 1: found '2'" SUN},
        {"spheer 0 0 0 1", "1:1: unknown statement (did you mean 'sphere'?): found 'spheer'"},
        {"??", "1:1: expected a statement (ambient, background, camera, define, light, material, "
               "max_level, mesh, normals, ply_file, sides, size, sphere, sun, "
               "up): found '\?\?'"},
        {"define gold matte\nmaterial gild",
         "2:10: undefined material (did you mean 'gold'?): found 'gild'" STATEMENT
         "'material NUMBER|NAME|own [NUMBER|NAME]'"},
        {"define a matte checker 0 1 1 1 0 0 0",
         "1:24: expected a number between 1e-30 and 1e+30: found '0'" DEFINE},
        {"define a matte checker 1 1 1 1 0 0 1.1",
         "1:36: expected a number between 0 and 1: found '1.1'" DEFINE},
        {"define red matte kd 0.5 kd 0.6", "1:25: the property is given twice: found 'kd'" DEFINE},
        {"define a matte difuse 1 1 1",
         "1:16: unknown property (did you mean 'diffuse'?): found 'difuse'" DEFINE},
        {"size 0 5", "1:6: expected an integer between 1 and 131072: found '0'" STATEMENT
                     "'size WIDTH HEIGHT'"},
        {"camera 0 0 0 0 0 0 45",
         "1:1: the camera looks at its own position: found 'camera'" CAMERA},
        {"camera 0 0 5 0 0 0 45", "1:1: the camera must not look along its 'up' vector: choose "
                                  "another, as 'up 0 1 0': found "
                                  "'camera'" CAMERA},
        {"up 0 -1 0\ncamera 0 5 0 0 0 0 45", "2:1: the camera must not look along its 'up' vector: "
                                             "choose another, as 'up 0 0 1': found "
                                             "'camera'" CAMERA},
        {"define jade matte color 0.2 0.7 0.4",
         "1:19: expected a property of a material (diffuse, checker, kd, specular, ks, "
         "shininess, reflectivity): found 'color'" DEFINE},
        {"define a glass diffuse 1 1 1",
         "1:16: expected a property of a material (color, ior): found 'diffuse'" DEFINE},
        {"define a glass ior 0", "1:20: expected a number between 0.1 and 10: found '0'" DEFINE},
        {"define a glas", "1:10: expected 'silhouette', 'matte', 'blinn_phong' or 'glass': found "
                          "'glas'" DEFINE},
        {"up 0 1 0", "1:1: no camera follows this 'up': found 'up'" STATEMENT "'up X Y Z'"},
        {"normals smooth 180.5",
         "1:16: expected a number between 0 and 180: found '180.5'" NORMALS},
        {"normals smooth soft", "1:16: expected a number: found 'soft'" NORMALS},
        {"normals flat 30", "1:14: expected nothing more: found '30'" NORMALS},
        {"normals round", "1:9: expected 'flat' or 'smooth': found 'round'" NORMALS},
        {"define a matte\ndefine a matte", "2:8: this name is already defined: found 'a'" DEFINE},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        expect_error(cases[i][0], cases[i][1]);
}

// Checks only that each message gives a line and a column.
TEST(impossible_values_are_refused_at_their_place)
{
    static const char *const texts[] = {"sphere 0 0 0 -1",
                                        "sphere 0 0 0 nan",
                                        "sphere 0 0 0 inf",
                                        "sphere nan 0 0 1",
                                        "sphere 0 inf 0 1",
                                        "\n\nsphere 0 0 0 -0",
                                        "sphere 1 2 3 1e400",
                                        "sphere 1,5 2 3 1",
                                        "sphere 0x1 0 0 1\n1 2",
                                        "light 0 0 1 -1",
                                        "light 0 0 1 inf",
                                        "light 0 0 nan 1",
                                        "\nlight 0 0 1 -1e-30",
                                        "camera 0 0 0 1 0 0 0",
                                        "camera 0 0 0 1 0 0 180",
                                        "camera 0 0 0 1 0 0 -4",
                                        "camera 0 0 0 1 0 0 nan",
                                        "camera 0 0 0 nan 0 0 40",
                                        "camera 0 0 0 1 0 0 inf",
                                        "camera 1 2 3",
                                        "up 1 2 3\ncamera 0 0 0 2 4 6 40",
                                        "up 0 0 -1\ncamera 1 1 1 1 1 -3 40",
                                        "up 0 0 0",
                                        "size 0 0",
                                        "size 5 0",
                                        "size -1 5",
                                        "size 131073 1",
                                        "size 1e3 nan",
                                        "size 2.5 2.5",
                                        "max_level -1",
                                        "background 2 0 0",
                                        "ambient nan",
                                        "define a matte kd",
                                        "material",
                                        "ply_file"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        Scene scene;
        Error error = {0};
        unsigned line, column;
        if (parse(&scene, texts[i], &error))
            fail_msg("'%s' is accepted", texts[i]);
        assert_int_equal(
            sscanf(strstr(error.text, "inline.scn:"), "inline.scn:%u:%u: ", &line, &column), 2);
    }
}

TEST(a_missing_mesh_is_an_error_at_its_path)
{
    Scene scene;
    Error error = {0};
    assert_false(parse(&scene, "ply_file nowhere.ply", &error));
    assert_non_null(strstr(error.text, "inline.scn:1:10: "));
    assert_non_null(strstr(error.text, "/scenes/nowhere.ply: cannot be opened: No such file"));
}

TEST(transforms_out_of_range_are_refused)
{
    Scene scene;
    Error error = {0};
    assert_false(parse(&scene, "mesh cube.ply scale 1e30 scale 1e30", &error));
    assert_non_null(strstr(error.text, "past 1e30"));
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
    expect_error("camera 1 2 3 4 5 6 30 180",
                 "1:23: expected a number between 1e-06 and 179.9999: found '180'" CAMERA);
}

TEST(an_orthographic_camera_has_a_height_and_may_have_a_width)
{
    FREED_BY(scene_free)
    Scene scene = parsed("camera 1 2 3 4 5 6 orthographic 7\ncamera 1 2 3 4 5 6 orthographic 7 8");
    assert_true(scene.viewpoints.data[0].height == 7 && scene.viewpoints.data[0].width == 0);
    assert_true(scene.viewpoints.data[1].height == 7 && scene.viewpoints.data[1].width == 8);
    expect_error("camera 1 2 3 4 5 6 orthographic",
                 "1:32: expected a number: found the end of the line" CAMERA);
    expect_error("camera 1 2 3 4 5 6 orthographic 0",
                 "1:33: expected a number between 1e-30 and 1e+30: found '0'" CAMERA);
    expect_error("camera 1 2 3 4 5 6 7 orthographic",
                 "1:22: expected a number: found 'orthographic'" CAMERA);
}

TEST(a_scene_distinguishes_the_courses_cameras_from_its_own)
{
    FREED_BY(scene_free) Scene plain = parsed(""), own = parsed("camera 1 2 3 4 5 6 30");
    assert_true(plain.has_course_views);
    assert_false(own.has_course_views);
}
