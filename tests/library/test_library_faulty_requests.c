// SPDX-License-Identifier: MIT
// Invalid requests to a renderer give an error with a message, and the next picture still renders.
// The library prints nothing and leaves the environment unchanged.
#define CL_TARGET_OPENCL_VERSION 120
#include "library/faults.h"
#include "library/filled.h"
#include "library/program.h"
#include "unit/cmocka_all.h"

#include <CL/cl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define WIDTH  8
#define HEIGHT 6

typedef struct {
    ClrtScene *scene;
    ClrtRenderer *renderer;
    float rgb[3 * WIDTH * HEIGHT];
    char *environment; // a copy from before the first call of the library
} Stage;

static Stage stage;

extern char **environ;

// Returns all environment variables as one string. The caller frees it.
static char *copy_environment(void)
{
    size_t size = 1;
    for (char **variable = environ; *variable != NULL; variable++)
        size += strlen(*variable) + 1;
    char *copy = calloc(size, 1);
    assert_non_null(copy);
    for (char **variable = environ; *variable != NULL; variable++)
        strcat(strcat(copy, *variable), "\n");
    return copy;
}

// Opens all drivers before the test copies the environment, because PoCL's driver sets a variable
// for hwloc when it is opened.
static void open_driver(void)
{
    cl_platform_id platforms[16];
    cl_device_id device;
    cl_uint count = 0;
    clGetPlatformIDs(16, platforms, &count);
    for (cl_uint i = 0; i < count && i < 16; i++)
        clGetDeviceIDs(platforms[i], CL_DEVICE_TYPE_ALL, 1, &device, NULL);
}

static ClrtRenderer *open_named(const char *device, ClrtError *error)
{
    const ClrtSettings settings = {.size = sizeof settings, .device = device};
    return clrt_renderer_create(&settings, error);
}

SET_UP(open_stage)
{
    open_driver();
    stage.environment = copy_environment();
    stage.scene = filled_make();
    stage.renderer = program_renderer(0);
    return stage.renderer == NULL;
}

TEAR_DOWN(close_stage)
{
    clrt_renderer_free(stage.renderer);
    clrt_scene_free(stage.scene);
    free(stage.environment);
    return 0;
}

TEST(null_arguments_are_named)
{
    ClrtScene *scene = stage.scene;
    const ClrtPicture picture = {.size = sizeof picture, .width = WIDTH, .height = HEIGHT};
    REFUSES(clrt_render(NULL, scene, &picture, stage.rgb, &error), "the renderer is NULL");
    REFUSES(clrt_render(stage.renderer, NULL, &picture, stage.rgb, &error), "the scene is NULL");
    REFUSES(clrt_render(stage.renderer, scene, NULL, stage.rgb, &error), "the picture is NULL");
    REFUSES(clrt_render(stage.renderer, scene, &picture, NULL, &error),
            "the picture's memory is NULL");
    assert_false(clrt_render(NULL, NULL, NULL, NULL, NULL));
    clrt_renderer_free(NULL);
}

static bool render(ClrtPicture picture, ClrtError *error)
{
    return clrt_render(stage.renderer, stage.scene, &picture, stage.rgb, error);
}

TEST(pictures_out_of_range_are_refused_and_the_next_is_drawn)
{
    const ClrtPicture good = {.size = sizeof good, .width = WIDTH, .height = HEIGHT};
    ClrtPicture bad[] = {good, good, good, good, good, good};
    static const char *const words[] = {
        "width is 4294967295",   "height is 131073",
        "samples is 65",         "max_level is 1001",
        "view 3 does not exist", "error is 0.00015, and below 0.00016 needs"};
    bad[0].width = UINT32_MAX;
    bad[1].height = 131073;
    bad[2].samples = 65;
    bad[3].max_level = 1001;
    bad[4].view = 3;
    bad[5].error = 0.00015;
    for (int i = 0; i < 6; i++)
        REFUSES(render(bad[i], &error), words[i]);
    ClrtCamera far = filled_cameras[0];
    far.eye[0] = 1e20;
    bad[0] = good;
    bad[0].camera = &far;
    REFUSES(render(bad[0], &error), "more than 5e11 times");
    far.size = 0;
    REFUSES(render(bad[0], &error), "the camera has a size of 0");
    assert_true(render(good, NULL));
}

TEST(the_size_of_a_struct_selects_its_members)
{
    struct {
        ClrtPicture picture;
        uint64_t later;
    } newer = {{.size = sizeof newer, .width = WIDTH, .height = HEIGHT}, 0};
    assert_true(clrt_render(stage.renderer, stage.scene, &newer.picture, stage.rgb, NULL));
    newer.later = 1;
    REFUSES(clrt_render(stage.renderer, stage.scene, &newer.picture, stage.rgb, &error),
            "sets members that libclrt");
    newer.picture.size = sizeof newer.picture.size - 1;
    REFUSES(render(newer.picture, &error), "the picture has a size of 7");
    newer.picture.size = SIZE_MAX;
    REFUSES(render(newer.picture, &error), "the picture has a size of");
}

TEST(members_that_an_older_program_does_not_know_have_defaults)
{
    float whole[3 * WIDTH * HEIGHT];
    ClrtPicture older = {.size = sizeof older, .width = WIDTH, .height = HEIGHT};
    assert_true(render(older, NULL));
    memcpy(whole, stage.rgb, sizeof whole);
    memset(&older.view, 0xff, sizeof older - offsetof(ClrtPicture, view));
    older.size = offsetof(ClrtPicture, view);
    assert_true(render(older, NULL));
    assert_memory_equal(stage.rgb, whole, sizeof whole);
    ClrtSceneInfo info = {.size = offsetof(ClrtSceneInfo, max_level), .max_level = 77};
    assert_true(clrt_scene_get_info(stage.scene, &info, NULL));
    assert_int_equal(info.height, 512);
    assert_int_equal(info.max_level, 77);
}

TEST(a_scene_without_cameras_is_drawn_with_the_pictures_camera)
{
    ClrtScene *scene = clrt_scene_create(NULL);
    ClrtPicture picture = {.size = sizeof picture, .width = WIDTH, .height = HEIGHT};
    REFUSES(clrt_render(stage.renderer, scene, &picture, stage.rgb, &error),
            "the scene has no camera");
    picture.camera = &filled_cameras[0];
    assert_true(clrt_render(stage.renderer, scene, &picture, stage.rgb, NULL));
    for (int i = 0; i < 3 * WIDTH * HEIGHT; i++)
        assert_true(stage.rgb[i] == 1); // the background
    clrt_scene_free(scene);
}

TEST(a_light_too_far_away_is_reported)
{
    ClrtError error = faults_blank();
    const double far[3] = {1e25, 0, 0}, near[3] = {0, 0, 0};
    const ClrtPicture picture = {
        .size = sizeof picture, .width = WIDTH, .height = HEIGHT, .camera = &filled_cameras[0]};
    ClrtScene *scene = clrt_scene_create(NULL);
    assert_true(clrt_scene_add_sphere(scene, near, 1, 0, NULL));
    assert_true(clrt_scene_add_light(scene, far, 1, NULL));
    faults_assert(clrt_render(stage.renderer, scene, &picture, stage.rgb, &error), &error,
                  CLRT_SCENE, "light 1 is more than 5e11 times");
    assert_true(clrt_render(stage.renderer, stage.scene, &picture, stage.rgb, NULL));
    clrt_scene_free(scene);
}

TEST(missing_devices_are_reported)
{
    ClrtError error = faults_blank();
    faults_assert(open_named("no such device %s", &error) != NULL, &error, CLRT_DEVICE,
                  "no device matches 'no such device %s'");
    assert_null(open_named("99:99", NULL));
}

static bool draw_again(void *user, uint64_t tiles_done, uint64_t tiles)
{
    ClrtError *error = user;
    const ClrtPicture picture = {.size = sizeof picture, .width = WIDTH, .height = HEIGHT};
    assert_true(tiles_done <= tiles);
    assert_false(clrt_render(stage.renderer, stage.scene, &picture, stage.rgb, error));
    return true;
}

TEST(a_renderer_that_draws_refuses_another_picture)
{
    ClrtError error = faults_blank();
    ClrtPicture picture = {.size = sizeof picture, .width = WIDTH, .height = HEIGHT};
    picture.progress = draw_again;
    picture.user = &error;
    assert_true(render(picture, NULL));
    faults_assert(false, &error, CLRT_ARGUMENT, "the renderer is busy with another call");
}

static void use_everything(void)
{
    const ClrtPicture picture = {.size = sizeof picture, .width = WIDTH, .height = HEIGHT};
    ClrtRenderer *renderer = program_renderer(1);
    clrt_render(renderer, stage.scene, &picture, stage.rgb, NULL);
    clrt_render(renderer, stage.scene, NULL, stage.rgb, NULL);
    clrt_renderer_free(renderer);
    clrt_renderer_free(open_named("nothing", NULL));
    clrt_scene_free(clrt_scene_load("/nowhere", NULL, NULL));
}

TEST(nothing_is_printed_and_the_environment_stays)
{
    FILE *printed = tmpfile();
    const int own[2] = {dup(STDOUT_FILENO), dup(STDERR_FILENO)};
    assert_non_null(printed);
    fflush(NULL);
    dup2(fileno(printed), STDOUT_FILENO);
    dup2(fileno(printed), STDERR_FILENO);
    use_everything();
    fflush(NULL);
    dup2(own[0], STDOUT_FILENO);
    dup2(own[1], STDERR_FILENO);
    close(own[0]);
    close(own[1]);
    fseek(printed, 0, SEEK_END);
    assert_int_equal(ftell(printed), 0);
    fclose(printed);
    char *after = copy_environment();
    assert_string_equal(stage.environment, after);
    free(after);
}
