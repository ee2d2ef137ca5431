// SPDX-License-Identifier: MIT
// Tests the messages about faults in scene text.
#include "unit/parsed.h"

static void expect_error(const char *text, const char *message)
{
    Scene scene;
    Error error = {0};
    assert_false(parse(&scene, text, &error));
    const char *place = strstr(error.text, "inline.scn:");
    assert_non_null(place);
    assert_string_equal(place + strlen("inline.scn:"), message);
}

#define STATEMENT "; the statement is "
#define LIGHT     STATEMENT "'light X Y Z INTENSITY [R G B] [area UX UY UZ VX VY VZ N]'"
#define SUN       STATEMENT "'sun X Y Z INTENSITY [R G B]'"
#define SPHERE    STATEMENT "'sphere X Y Z RADIUS'"
#define DEFINE    STATEMENT "'define NAME silhouette|matte|blinn_phong|glass [PROPERTY VALUES]...'"
#define CHECKER   STATEMENT "'define NAME KIND ... checker SIZE R G B R G B ...'"
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
        {"material gold\ndefine gold matte",
         "1:10: expected an integer or the name of a 'define' above: found 'gold'" STATEMENT
         "'material NUMBER|NAME|own [NUMBER|NAME]'"},
        {"define gold matte\nmaterial gild",
         "2:10: undefined material (did you mean 'gold'?): found 'gild'" STATEMENT
         "'material NUMBER|NAME|own [NUMBER|NAME]'"},
        {"define a matte checker 0 1 1 1 0 0 0",
         "1:24: expected a number between 1e-30 and 1e+30: found '0'" CHECKER},
        {"define a matte checker 1 1 1 1 0 0 1.1",
         "1:36: expected a number between 0 and 1: found '1.1'" CHECKER},
        {"define a matte diffuse 1 1",
         "1:27: expected a number: found the end of the line" STATEMENT
         "'define NAME KIND ... diffuse R G B ...'"},
        {"define a matte diffuse 1 1 1 1",
         "1:30: expected a property of a material (diffuse, checker, kd, specular, ks, shininess, "
         "reflectivity): found '1'" DEFINE},
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
        {"define a glass ior 0", "1:20: expected a number between 0.1 and 10: found '0'" STATEMENT
                                 "'define NAME KIND ... ior V ...'"},
        {"define a glas", "1:10: expected 'silhouette', 'matte', 'blinn_phong' or 'glass': found "
                          "'glas'" DEFINE},
        {"up 0 1 0", "1:1: no camera follows this 'up': found 'up'" STATEMENT "'up X Y Z'"},
        {"normals smooth 180.5",
         "1:16: expected a number between 0 and 180: found '180.5'" NORMALS},
        {"normals smooth soft", "1:16: expected a number: found 'soft'" NORMALS},
        {"normals flat 30", "1:14: expected nothing more: found '30'" NORMALS},
        {"normals round", "1:9: expected 'flat' or 'smooth': found 'round'" NORMALS},
        {"define a matte\ndefine a matte", "2:8: this name is already defined: found 'a'" DEFINE},
        {"camera 1 2 3 4 5 6 30 180",
         "1:23: expected a number between 1e-06 and 179.9999: found '180'" CAMERA},
        {"camera 1 2 3 4 5 6 orthographic",
         "1:32: expected a number: found the end of the line" CAMERA},
        {"camera 1 2 3 4 5 6 orthographic 0",
         "1:33: expected a number between 1e-30 and 1e+30: found '0'" CAMERA},
        {"camera 1 2 3 4 5 6 7 orthographic",
         "1:22: expected a number: found 'orthographic'" CAMERA},
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
