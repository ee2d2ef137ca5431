// SPDX-License-Identifier: MIT
// Tests the messages about faults in scene text.
#include "unit/parsed.h"

// Expects a message at the place, with the keyword and the form of the statement. A statement that
// is NULL has no form.
static void expect_error(const char *const expected[4])
{
    Scene scene;
    Error error = {0};
    char form[64], place[32];
    assert_false(parse(&scene, expected[0], &error));
    snprintf(place, sizeof place, "inline.scn:%s ", expected[1]);
    const char *statement = strstr(error.text, "; the statement is '");
    snprintf(form, sizeof form, "%s ", expected[3] != NULL ? expected[3] : "");
    if (strstr(error.text, place) == NULL || strstr(error.text, expected[2]) == NULL)
        fail_msg("'%s' is not at %s or lacks '%s'", error.text, place, expected[2]);
    if (expected[3] == NULL ? statement != NULL
                            : statement == NULL || strstr(statement, form) == NULL)
        fail_msg("'%s' has another form than '%s'", error.text, form);
}

TEST(faults_name_line_column_and_the_statement)
{
    static const char *const cases[][4] = {
        {"\nlight 1 2\n", "2:10:", "end of the line", "light"},
        {"sphere 0 0 zero 1", "1:12:", "a number", "sphere"},
        {"sphere 0 0 0 1 5", "1:16:", "nothing more", "sphere"},
        {"sphere 0 0 0 0", "1:14:", "between 1e-30 and 1e+30", "sphere"},
        {"sphere 0 0 0 3e-31", "1:14:", "between 1e-30 and 1e+30", "sphere"},
        {"light 0 0 0 nan", "1:13:", "a number", "light"},
        {"light 1e39 0 0 1", "1:7:", "between -1e+30 and 1e+30", "light"},
        {"light 0 0 0 1 1 0", "1:18:", "end of the line", "light"},
        {"light 0 0 0 1 1 0 1.5", "1:19:", "between 0 and 1", "light"},
        {"light 0 0 0 1 1 1 1 1", "1:21:", "nothing more", "light"},
        {"light 0 0 0 1 area 1 0 0 0 1 0", "1:31:", "between 1 and 16", "light"},
        {"light 0 0 0 1 area 1 0 0 0 1 0 17", "1:32:", "between 1 and 16", "light"},
        {"sun 0 0 1 1 area 1 0 0 0 1 0 2", "1:13:", "nothing more", "sun"},
        {"sun 0 0 0 1", "1:11:", "must not be zero", "sun"},
        {"sun 0 0 1 1 2", "1:13:", "between 0 and 1", "sun"},
        {"spheer 0 0 0 1", "1:1:", "'sphere'", NULL},
        {"??", "1:1:", "a statement", NULL},
        {"material gold\ndefine gold matte", "1:10:", "an integer", "material"},
        {"define gold matte\nmaterial gild", "2:10:", "'gold'", "material"},
        {"define a matte checker 0 1 1 1 0 0 0", "1:24:", "between 1e-30 and 1e+30", "checker"},
        {"define a matte checker 1 1 1 1 0 0 1.1", "1:36:", "between 0 and 1", "checker"},
        {"define a matte diffuse 1 1", "1:27:", "end of the line", "diffuse"},
        {"define a matte diffuse 1 1 1 1", "1:30:", "a property", "define"},
        {"define red matte kd 0.5 kd 0.6", "1:25:", "twice", "define"},
        {"define a matte difuse 1 1 1", "1:16:", "'diffuse'", "define"},
        {"size 0 5", "1:6:", "between 1 and 131072", "size"},
        {"camera 0 0 0 0 0 0 45", "1:1:", "its own position", "camera"},
        {"camera 0 0 5 0 0 0 45", "1:1:", "as 'up 0 1 0'", "camera"},
        {"up 0 -1 0\ncamera 0 5 0 0 0 0 45", "2:1:", "as 'up 0 0 1'", "camera"},
        {"define jade matte color 0.2 0.7 0.4", "1:19:", "a property", "define"},
        {"define a glass diffuse 1 1 1", "1:16:", "(color, ior)", "define"},
        {"define a glass ior 0", "1:20:", "between 0.1 and 10", "ior"},
        {"define a glas", "1:10:", "expected 'silhouette'", "define"},
        {"up 0 1 0", "1:1:", "no camera follows", "up"},
        {"normals smooth 180.5", "1:16:", "between 0 and 180", "normals"},
        {"normals smooth soft", "1:16:", "a number", "normals"},
        {"normals flat 30", "1:14:", "nothing more", "normals"},
        {"normals round", "1:9:", "expected 'flat'", "normals"},
        {"define a matte\ndefine a matte", "2:8:", "already defined", "define"},
        {"camera 1 2 3 4 5 6 30 180", "1:23:", "between 1e-06 and 179.9999", "camera"},
        {"camera 1 2 3 4 5 6 orthographic", "1:32:", "end of the line", "camera"},
        {"camera 1 2 3 4 5 6 orthographic 0", "1:33:", "between 1e-30 and 1e+30", "camera"},
        {"camera 1 2 3 4 5 6 7 orthographic", "1:22:", "a number", "camera"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        expect_error(cases[i]);
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
