// SPDX-License-Identifier: MIT
// Tests devices, the settings of renderers, and ways to load and fill scenes. Pictures must equal
// the pictures of the program.
#include "library/faults.h"
#include "library/filled.h"
#include "library/renderer.h"

#include <stdlib.h>
#include <string.h>

#define WIDTH  60
#define HEIGHT 50

static const ClrtPicture picture = {
    .size = sizeof picture, .width = WIDTH, .height = HEIGHT, .samples = 1};

// Requires the library's picture to equal the program's picture of the file. Frees the scene.
static void expect_program(ClrtScene *scene, const char *file, const char *options)
{
    assert_non_null(scene);
    float *expected = program_draw(program_file(file), options, WIDTH, HEIGHT);
    assert_true(program_agrees(renderer, scene, &picture, expected));
    free(expected);
    clrt_scene_free(scene);
}

TEST(devices_are_listed_and_can_be_opened)
{
    uint32_t count = 0;
    ClrtDevice device = {.size = sizeof device};
    assert_true(clrt_device_count(&count, NULL));
    assert_true(count > 0);
    REFUSES(clrt_device_get(count, &device, &error), "does not exist");
    REFUSES(clrt_device_get(0, NULL, &error), "the device is NULL");
    REFUSES(clrt_device_count(NULL, &error), "the count is NULL");
    for (uint32_t i = 0; i < count; i++) {
        assert_true(clrt_device_get(i, &device, NULL));
        assert_int_equal(device.size, sizeof device);
        assert_true(device.name[0] != '\0' && device.platform[0] != '\0');
        assert_true(device.compute_units > 0 && device.largest_allocation > 0);
    }
    const ClrtSettings settings = {.size = sizeof settings, .device = device.device};
    ClrtRenderer *last = clrt_renderer_create(&settings, NULL);
    assert_non_null(last);
    clrt_renderer_free(last);
}

TEST(a_shorter_device_is_filled_up_to_its_size)
{
    ClrtDevice device = {.size = offsetof(ClrtDevice, compute_units), .compute_units = 77};
    assert_true(clrt_device_get(0, &device, NULL));
    assert_int_equal(device.size, offsetof(ClrtDevice, compute_units));
    assert_true(device.name[0] != '\0');
    assert_int_equal(device.compute_units, 77);
}

TEST(settings_for_experiments_change_no_bit)
{
    const ClrtSettings settings[] = {{.kernel = CLRT_KERNEL_PAIR, .group_width = 4},
                                     {.kernel = CLRT_KERNEL_WIDE, .lanes = 4},
                                     {.tree = CLRT_TREE_NONE, .kernel = CLRT_KERNEL_PACKET},
                                     {.tree = CLRT_TREE_MIDPOINT},
                                     {.specialize = CLRT_SPECIALIZE_ALWAYS}};
    ClrtScene *scene = filled_make();
    float *expected =
        program_draw(program_file("tests/library/filled.scn"), "--max-level 3", WIDTH, HEIGHT);
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        ClrtSettings own = settings[i];
        own.size = sizeof own;
        own.device = getenv("CLRT_DEVICE");
        ClrtRenderer *other = clrt_renderer_create(&own, NULL);
        assert_non_null(other);
        assert_true(program_agrees(other, scene, &picture, expected));
        clrt_renderer_free(other);
    }
    free(expected);
    clrt_scene_free(scene);
}

TEST(fp64_is_the_programs)
{
    const ClrtSettings settings = {
        .size = sizeof settings, .device = getenv("CLRT_DEVICE"), .precision = CLRT_FP64};
    ClrtRenderer *exact = clrt_renderer_create(&settings, NULL);
    assert_non_null(exact);
    ClrtScene *scene = filled_make();
    float *expected = program_draw(program_file("tests/library/filled.scn"),
                                   "--precision fp64 --max-level 3", WIDTH, HEIGHT);
    assert_true(program_agrees(exact, scene, &picture, expected));
    assert_false(program_agrees(renderer, scene, &picture, expected));
    free(expected);
    clrt_scene_free(scene);
    clrt_renderer_free(exact);
}

static bool opens(ClrtSettings settings, ClrtError *error)
{
    settings.size = sizeof settings;
    return clrt_renderer_create(&settings, error) != NULL;
}

TEST(bad_settings_are_refused)
{
    const ClrtSettings none = {.size = 3};
    REFUSES(clrt_renderer_create(&none, &error) != NULL, "the settings has a size of 3");
    REFUSES(opens((ClrtSettings){.kernel = 4}, &error), "the kernel is 4");
    REFUSES(opens((ClrtSettings){.tree = 4}, &error), "the tree is 4");
    REFUSES(opens((ClrtSettings){.specialize = 3}, &error), "specialize is 3");
    REFUSES(opens((ClrtSettings){.precision = 2}, &error), "the precision is 2");
    REFUSES(opens((ClrtSettings){.group_width = 1025}, &error), "the group's width is 1025");
    static const ClrtSettings contradictions[] = {
        {.precision = CLRT_FP64, .kernel = CLRT_KERNEL_WIDE},
        {.kernel = CLRT_KERNEL_WIDE, .lanes = 5},
        {.kernel = CLRT_KERNEL_PAIR, .lanes = 8},
        {.lanes = 8},
    };
    for (size_t i = 0; i < sizeof contradictions / sizeof *contradictions; i++)
        REFUSES(opens(contradictions[i], &error), "contradict each other");
}

TEST(a_mesh_file_is_turned_and_smoothed_as_by_the_program)
{
    static const char mesh[] = "scenes/tetrahedron.ply";
    const ClrtLoad loads[] = {{.up = CLRT_UP_MINUS_Y, .flat = true},
                              {.up = CLRT_UP_X, .crease_degrees = 120},
                              {.soft = true}};
    const char *const options[] = {"--aa=1 --up=-y --normals=flat",
                                   "--aa=1 --up=x --normals=smooth=120", "--aa=1 --studio=soft"};
    for (int i = 0; i < 3; i++) {
        ClrtLoad load = loads[i];
        load.size = sizeof load;
        expect_program(clrt_scene_load(program_file(mesh), &load, NULL), mesh, options[i]);
    }
    ClrtLoad load = {.size = sizeof load, .crease_degrees = 181};
    REFUSES(clrt_scene_load(program_file(mesh), &load, &error) != NULL, "the crease angle is 181");
    load.crease_degrees = 33;
    load.flat = true;
    REFUSES(clrt_scene_load(program_file(mesh), &load, &error) != NULL, "flat and has a crease");
    load.crease_degrees = 0;
    load.up = 7;
    REFUSES(clrt_scene_load(program_file(mesh), &load, &error) != NULL, "the up axis is 7");
}

TEST(missing_normals_are_computed_as_by_the_program)
{
    const double lamp[3] = {3, -4, 6};
    ClrtMesh roof = filled_meshes[1];
    roof.smooth = true;
    roof.crease_degrees = 40;
    ClrtScene *scene = clrt_scene_create(NULL);
    assert_true(clrt_scene_add_light(scene, lamp, 0.8, NULL));
    assert_true(clrt_scene_add_camera(scene, &filled_cameras[0], NULL));
    assert_true(clrt_scene_add_mesh(scene, &roof, NULL));
    roof.flat = true;
    REFUSES(clrt_scene_add_mesh(scene, &roof, &error), "the mesh is flat and smooth");
    roof.flat = false;
    roof.crease_degrees = -1;
    REFUSES(clrt_scene_add_mesh(scene, &roof, &error), "the crease angle is -1");
    roof.crease_degrees = 33;
    roof.smooth = false;
    REFUSES(clrt_scene_add_mesh(scene, &roof, &error), "crease angle, but is not smooth");
    expect_program(scene, "tests/library/smooth.scn", "");
}

TEST(cameras_of_a_loaded_scene_draw_their_views)
{
    static const char mesh[] = "scenes/tetrahedron.ply";
    ClrtScene *scene = clrt_scene_load(program_file(mesh), NULL, NULL);
    ClrtCamera camera = {.size = sizeof camera};
    ClrtPicture narrow = {
        .size = sizeof narrow, .width = 20, .height = 90, .samples = 1, .camera = &camera};
    REFUSES(clrt_scene_get_camera(scene, 0, &camera, &error), "view 0 does not exist");
    REFUSES(clrt_scene_get_camera(scene, 7, &camera, &error), "view 7 does not exist");
    REFUSES(clrt_scene_get_camera(NULL, 1, &camera, &error), "the scene is NULL");
    assert_true(clrt_scene_get_camera(scene, 2, &camera, NULL));
    assert_true(camera.width_degrees > 0);
    float *expected = program_draw(program_file(mesh), "--aa=1 --view 2", 20, 90);
    assert_true(program_agrees(renderer, scene, &narrow, expected));
    free(expected);
    clrt_scene_free(scene);
}
