// SPDX-License-Identifier: MIT
// Tests requests beyond a plain picture: goals, crops, turns, levels, statistics, channels,
// certainty and references. Most results must equal the program's results, bit for bit.
#include "base/error.h"
#include "image/image_file.h"
#include "library/faults.h"
#include "library/filled.h"
#include "library/renderer.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define WIDTH  60
#define HEIGHT 50
#define PIXELS (WIDTH * HEIGHT)

static ClrtScene *scene; // of reflections.scn
static float rgb[3 * PIXELS];
static const char file[] = "scenes/reflections.scn";

SET_UP(load_scene)
{
    scene = clrt_scene_load(program_file(file), NULL, NULL);
    return scene == NULL;
}

TEAR_DOWN(free_scene)
{
    clrt_scene_free(scene);
    return 0;
}

static ClrtPicture request(void)
{
    return (ClrtPicture){.size = sizeof(ClrtPicture), .width = WIDTH, .height = HEIGHT};
}

// Draws the picture and expects the program's picture. Returns the results.
static ClrtResult expect_program(ClrtPicture picture, const char *options)
{
    ClrtError error;
    ClrtResult result = {.size = sizeof result};
    float *expected = program_draw(program_file(file), options, WIDTH, HEIGHT);
    picture.result = &result;
    if (!clrt_render(renderer, scene, &picture, rgb, &error))
        fail_msg("%s", error.text);
    assert_memory_equal(rgb, expected, sizeof rgb);
    free(expected);
    return result;
}

TEST(goals_are_the_programs)
{
    ClrtPicture picture = request();
    picture.contrast = 0.05;
    const ClrtResult adaptive = expect_program(picture, "--aa-adaptive=0.05");
    assert_true(adaptive.sample_count > PIXELS);
    picture.contrast = 0;
    picture.error = 0.02;
    const ClrtResult refined = expect_program(picture, "--error 2%");
    assert_true(refined.error_bound > refined.error && refined.error_bound <= 0.02);
    assert_true(refined.max_level > 0 && refined.truncation <= 0.005);
    assert_false(refined.goal_missed);
    picture.max_level = 2;
    assert_int_equal(expect_program(picture, "--error 2% --max-level 2").max_level, 2);
}

TEST(kernels_are_cached_after_a_renderer_compiled_them)
{
    ClrtPicture picture = request();
    ClrtResult result = {.size = sizeof result};
    picture.contrast = 0.5;
    picture.result = &result;
    for (int i = 0; i < 2; i++) {
        ClrtRenderer *own = program_renderer(0);
        assert_true(own != NULL && clrt_render(own, scene, &picture, rgb, NULL));
        clrt_renderer_free(own);
    }
    assert_true(result.cached);
}

TEST(a_time_is_spent_or_missed)
{
    ClrtResult result = {.size = sizeof result};
    ClrtPicture picture = request();
    picture.seconds = 0.2;
    picture.result = &result;
    assert_true(clrt_render(renderer, scene, &picture, rgb, NULL));
    assert_true(result.sample_count > PIXELS && result.error_bound > 0);
}

TEST(levels_may_be_none_or_follow_an_error)
{
    ClrtPicture picture = request();
    picture.max_level = CLRT_LEVEL_NONE;
    const ClrtResult none = expect_program(picture, "--max-level 0");
    assert_true(none.max_level == 0 && none.truncation == 1);
    picture.max_level = 0;
    assert_int_equal(expect_program(picture, "").max_level, 3);
    picture.truncation = 0x1p-25;
    assert_true(expect_program(picture, "--max-level auto").max_level > 3);
}

TEST(a_turned_camera_is_the_turntables)
{
    ClrtCamera camera = {.size = sizeof camera};
    ClrtPicture picture = request();
    float turned[3 * PIXELS];
    assert_true(clrt_scene_get_camera(scene, 1, &camera, NULL));
    picture.turn_degrees = 90;
    assert_true(clrt_render(renderer, scene, &picture, turned, NULL));
    const double x = camera.eye[0] - camera.look_at[0], y = camera.eye[1] - camera.look_at[1];
    picture.turn_degrees = -90;
    picture.camera = &camera;
    camera.eye[0] = camera.look_at[0] - y;
    camera.eye[1] = camera.look_at[1] + x;
    assert_true(clrt_render(renderer, scene, &picture, rgb, NULL));
    picture.camera = NULL;
    picture.turn_degrees = 0;
    float *original = program_draw(program_file(file), "", WIDTH, HEIGHT);
    assert_memory_not_equal(turned, original, sizeof turned);
    size_t differing = 0;
    for (int i = 0; i < 3 * PIXELS; i++)
        differing += fabsf(rgb[i] - original[i]) > 1e-3f;
    assert_true(differing < PIXELS / 20); // the turned eye is rounded
    free(original);
}

TEST(a_crop_is_a_part_of_the_picture)
{
    ClrtResult result = {.size = sizeof result};
    ClrtPicture picture = request();
    float crop[3 * 20 * 10];
    assert_true(clrt_render(renderer, scene, &picture, rgb, NULL));
    picture.left = 15;
    picture.top = 30;
    picture.crop_width = 20;
    picture.crop_height = 10;
    picture.tile_width = picture.tile_height = 8;
    picture.result = &result;
    assert_true(clrt_render(renderer, scene, &picture, crop, NULL));
    assert_true(result.width == 20 && result.height == 10);
    for (int row = 0; row < 10; row++)
        assert_memory_equal(crop + 60 * row, rgb + 3 * (WIDTH * (30 + row) + 15), 60 * sizeof *rgb);
    picture.left = 41;
    REFUSES(clrt_render(renderer, scene, &picture, crop, &error), "the crop is not inside");
    picture.crop_width = 0;
    REFUSES(clrt_render(renderer, scene, &picture, crop, &error), "the crop is not inside");
}

TEST(statistics_count_rays_and_tests)
{
    ClrtPicture picture = request();
    const ClrtResult without = expect_program(picture, "");
    picture.statistics = true;
    const ClrtResult counted = expect_program(picture, "");
    assert_true(without.camera_rays == 0 && without.sample_count == PIXELS);
    assert_true(counted.camera_rays == PIXELS && counted.samples == 1);
    assert_true(counted.camera_hits > 0 && counted.camera_hits <= PIXELS);
    assert_true(counted.shadow_rays > 0 && counted.reflected_rays > 0);
    assert_true(counted.triangle_tests + counted.sphere_tests > 0);
    assert_true(counted.shaded_points > 0 && counted.seconds > 0);
}

TEST(the_hash_is_the_programs)
{
    char hash[33], command[1024], expected[64] = "";
    const ClrtPicture picture = request();
    assert_true(clrt_render(renderer, scene, &picture, rgb, NULL));
    clrt_hash(rgb, WIDTH, HEIGHT, hash);
    snprintf(command, sizeof command, "'%s' '%s' -q -s %dx%d --hash", CLRT_PROGRAM,
             program_file(file), WIDTH, HEIGHT);
    FILE *output = popen(command, "r");
    assert_non_null(output);
    assert_non_null(fgets(expected, sizeof expected, output));
    assert_int_equal(pclose(output), 0);
    expected[strcspn(expected, "\n")] = '\0';
    assert_string_equal(hash, expected);
}

// Reads the channels of the EXR file that the program draws.
static StoredImage program_channels(const char *options)
{
    Error error = {0};
    StoredImage image;
    char command[2048], path[] = "/tmp/clrt-library-XXXXXX.exr";
    const int handle = mkstemps(path, 4);
    assert_true(handle >= 0);
    close(handle);
    snprintf(command, sizeof command, "'%s' '%s' -q -s %dx%d %s -o %s", CLRT_PROGRAM,
             program_file(file), WIDTH, HEIGHT, options, path);
    assert_int_equal(system(command), 0);
    if (!image_read(&image, path, &error))
        fail_msg("%s", error.text);
    unlink(path);
    return image;
}

// Expects the program's values of a channel. layers are the names of its components in the file.
static void expect_channel(const StoredImage *image, const void *values, bool is_integer,
                           const char *const layers[3], uint32_t components)
{
    for (uint32_t component = 0; component < components; component++) {
        const int place = stored_image_channel(image, layers[component]);
        assert_true(place >= 0);
        for (uint32_t pixel = 0; pixel < PIXELS; pixel++) {
            const uint32_t at = pixel * components + component;
            const float *expected =
                &image->values[(size_t)pixel * image->channel_count + (uint32_t)place];
            // Ids are integers, which the image stores as floats with the same bits.
            assert_memory_equal(is_integer ? (const void *)&((const uint32_t *)values)[at]
                                           : (const void *)&((const float *)values)[at],
                                expected, sizeof *expected);
        }
    }
}

TEST(channels_are_the_programs)
{
    static const char *const layers[][3] = {
        {"Z"},        {"N.X", "N.Y", "N.Z"}, {"P.X", "P.Y", "P.Z"}, {"primitive"}, {"material"},
        {"shadow"},   {"bounces"},           {"samples"},           {"boxtests"},  {"tritests"},
        {"certainty"}};
    static uint32_t values[11][3 * PIXELS];
    static ClrtChannelInfo infos[11];
    ClrtChannel channels[11];
    assert_int_equal(clrt_channel_count(), 11);
    for (uint32_t i = 0; i < 11; i++) {
        infos[i].size = sizeof *infos;
        assert_true(clrt_channel_get(i, &infos[i], NULL));
        channels[10 - i] = (ClrtChannel){infos[i].name, values[i]};
    }
    ClrtPicture picture = request();
    ClrtResult result = {.size = sizeof result};
    picture.samples = 2;
    picture.channels = channels;
    picture.channel_count = 11;
    picture.result = &result;
    assert_true(clrt_render(renderer, scene, &picture, rgb, NULL));
    // The library traces packets. Without cached kernels, the program would trace single rays, and
    // its channels would count other numbers of tests.
    StoredImage image = program_channels("--aa=2 --aov all --tune kernel=packet");
    expect_channel(&image, rgb, false, (const char *const[]){"R", "G", "B"}, 3);
    for (uint32_t i = 0; i < 11; i++)
        expect_channel(&image, values[i], infos[i].is_integer, layers[i], infos[i].components);
    assert_int_equal(result.pixels_open + result.pixels_repaired + result.pixels_certified, PIXELS);
    assert_true(result.pixels_certified > PIXELS / 2);
    stored_image_free(&image);
}

TEST(the_reference_is_the_programs)
{
    char path[] = "/tmp/clrt-library-XXXXXX.pfm", options[256];
    ClrtPicture picture = request();
    ClrtResult result = {.size = sizeof result};
    const int handle = mkstemps(path, 4);
    assert_true(handle >= 0);
    close(handle);
    picture.reference_samples = 16;
    picture.max_level = 1; // the reference has the scene's level
    picture.result = &result;
    assert_true(clrt_reference(renderer, scene, &picture, rgb, NULL));
    snprintf(options, sizeof options, "--reference=%s --reference-samples 16 --max-level 1", path);
    free(program_draw(program_file(file), options, WIDTH, HEIGHT));
    float *expected = program_read(path, WIDTH, HEIGHT);
    assert_memory_equal(rgb, expected, sizeof rgb);
    assert_true(result.error > 0 && result.error < 0.1);
    assert_int_equal(result.max_level, 3);
    assert_int_equal(result.sample_count, 16 * PIXELS);
    free(expected);
    unlink(path);
}

static bool render(ClrtPicture picture, ClrtError *error)
{
    return clrt_render(renderer, scene, &picture, rgb, error);
}

TEST(requests_that_contradict_themselves_are_refused)
{
    float values[PIXELS];
    const ClrtChannel certainty = {"certainty", values}, tests = {"tritests", values};
    const ClrtChannel twice[] = {certainty, certainty}, unknown = {"nothing", values},
                      error_channel = {"error", values}, no_memory = {"depth", NULL};
    const ClrtPicture good = request();
    const struct {
        const char *words;
        ClrtPicture change;
    } bad[] = {
        {"samples and error exclude each other", {.samples = 2, .error = 0.1}},
        {"contrast and seconds exclude each other", {.contrast = 0.1, .seconds = 1}},
        {"error and seconds exclude each other", {.error = 0.1, .seconds = 1}},
        {"crop and contrast exclude", {.contrast = 0.1, .crop_width = 9, .crop_height = 9}},
        {"tile and seconds exclude", {.seconds = 0.1, .tile_width = 9}},
        {"certainty and error exclude", {.error = 1, .channels = &certainty, .channel_count = 1}},
        {"tritests and error exclude", {.error = 1, .channels = &tests, .channel_count = 1}},
        {"truncation and max_level exclude", {.truncation = 0.1, .max_level = 3}},
        {"contrast is 1.5", {.contrast = 1.5}},
        {"seconds is -1", {.seconds = -1}},
        {"error is nan", {.error = NAN}},
        {"max_level is -2", {.max_level = -2}},
        {"turn_degrees is inf", {.turn_degrees = INFINITY}},
        {"reference_samples is odd", {.reference_samples = 3}},
        {"the channels is NULL", {.channel_count = 1}},
        {"'certainty' occurs twice", {.channels = twice, .channel_count = 2}},
        {"there is no channel 'nothing'", {.channels = &unknown, .channel_count = 1}},
        {"there is no channel 'error'", {.channels = &error_channel, .channel_count = 1}},
        {"a channel's memory is NULL", {.channels = &no_memory, .channel_count = 1}},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        ClrtPicture picture = bad[i].change;
        picture.size = good.size;
        picture.width = good.width;
        picture.height = good.height;
        REFUSES(render(picture, &error), bad[i].words);
    }
    ClrtPicture picture = good;
    picture.channels = &certainty;
    picture.channel_count = 1;
    REFUSES(clrt_reference(renderer, scene, &picture, rgb, &error), "a reference has no channels");
    ClrtChannelInfo info = {.size = sizeof info};
    REFUSES(clrt_channel_get(clrt_channel_count(), &info, &error), "does not exist");
    assert_true(render(good, NULL));
}

static bool stop_second_call(void *user, uint64_t tiles_done, uint64_t tiles)
{
    int *calls = user;
    (void)tiles_done, (void)tiles;
    return ++*calls < 2;
}

TEST(every_pass_can_be_stopped)
{
    float values[3 * PIXELS];
    const ClrtChannel channels[] = {{"normal", values}, {"certainty", values}};
    ClrtPicture pictures[] = {request(), request(), request()};
    pictures[0].channels = &channels[0];
    pictures[1].channels = &channels[1];
    pictures[0].channel_count = pictures[1].channel_count = 1;
    pictures[2].contrast = 0.01;
    for (int i = 0; i < 3; i++) {
        int calls = 0;
        ClrtError error = faults_blank();
        pictures[i].tile_width = pictures[i].tile_height = i < 2 ? 32 : 0;
        pictures[i].progress = stop_second_call;
        pictures[i].user = &calls;
        faults_assert(render(pictures[i], &error), &error, CLRT_STOPPED, "was stopped after");
        assert_int_equal(calls, 2);
    }
}

static bool stop_last_call(void *user, uint64_t tiles_done, uint64_t tiles)
{
    (void)user;
    return tiles_done < tiles;
}

TEST(after_the_last_tile_nothing_is_left_to_stop)
{
    static float expected[3 * PIXELS];
    ClrtPicture picture = request();
    picture.reference_samples = 2;
    assert_true(clrt_reference(renderer, scene, &picture, expected, NULL));
    picture.progress = stop_last_call;
    assert_true(clrt_reference(renderer, scene, &picture, rgb, NULL));
    assert_memory_equal(rgb, expected, sizeof rgb);
    assert_true(render(picture, NULL));
}
