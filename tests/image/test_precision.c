// SPDX-License-Identifier: MIT
// Compares fp64 pictures with the oracle, which traces the same stored numbers in fp64 by other
// methods. Compares fp32 pictures with fp64 pictures, which differ by rounding.
#include "image/course.h"
#include "image/inline_scenes.h"
#include "image/picture.h"
#include "oracle/stored.h"
#include "scene/camera.h"
#include "scene/scn.h"
#include "unit/cmocka_all.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

// The largest difference of two colors rounded to float, plus a rounding to steps of 2^-32.
#define ROUNDED 0x1.01p-23f

// The oracle would take minutes for all pixels of a mesh.
#define MESH_STEP 16

static void rendered(Framebuffer *picture, const char *path, uint32_t view, Precision precision)
{
    Error error = {0};
    PictureRequest request = picture_request(path, view);
    request.choice = (KernelChoice){FAMILY_RAY, NODES_PAIR, 0, precision};
    request.group_width = request.group_height = 8;
    if (!picture_render(picture, &request, &error))
        fail_msg("%s", error.text);
}

static float pixel_difference(const float a[3], const float b[3])
{
    return fmaxf(fabsf(a[0] - b[0]), fmaxf(fabsf(a[1] - b[1]), fabsf(a[2] - b[2])));
}

typedef struct {
    uint32_t step; // compares every step-th pixel of every step-th row
    float tolerance;
} Comparing;

// Returns the number of pixels that differ by more than the tolerance. expected contains every
// step-th pixel of every step-th row.
static uint32_t count_differing(const Framebuffer *picture, const Framebuffer *expected,
                                const Comparing *comparing)
{
    const uint32_t step = comparing->step;
    uint32_t differing = 0;
    for (uint32_t y = 0; y < expected->height; y++)
        for (uint32_t x = 0; x < expected->width; x++) {
            const float *one = picture->pixels[(size_t)y * step * picture->width + x * step];
            const float *other = expected->pixels[(size_t)y * expected->width + x];
            differing += !(pixel_difference(one, other) <= comparing->tolerance);
        }
    return differing;
}

// A scene with its numbers as stored for the device, and its cameras.
typedef struct {
    Scene scene;
    Normalization normalization;
    Oracle oracle;
} Stored;

static void stored_open(Stored *stored, const char *path)
{
    Error error = {0};
    *stored = (Stored){0};
    if (!scn_load(&stored->scene, path, ply_parse, &error))
        fail_msg("%s", error.text);
    stored->normalization = normalization_of(&stored->scene);
    if (!stored_round(&stored->scene, &stored->normalization, &error) ||
        !oracle_make(&stored->oracle, &stored->scene, &error))
        fail_msg("%s", error.text);
}

static void stored_close(Stored *stored)
{
    oracle_free(&stored->oracle);
    scene_free(&stored->scene);
}

static uint32_t view_differences(const Stored *stored, const char *path, uint32_t view,
                                 const Comparing *comparing)
{
    Error error = {0};
    Framebuffer picture, expected;
    const Scene *scene = &stored->scene;
    const CameraData camera = camera_make(&scene->viewpoints.data[view - 1], &stored->normalization,
                                          scene->width, scene->height, 1);
    const OracleView rays = stored_view(&stored->oracle, &camera, scene->width, scene->height);
    const uint32_t step = comparing->step;
    if (!oracle_draw(&rays, 1, step, &expected, &error))
        fail_msg("%s", error.text);
    rendered(&picture, path, view, PRECISION_FP64);
    const uint32_t differing = count_differing(&picture, &expected, comparing);
    print_message("%s view %u: %u of %u pixels differ from the oracle's\n", strrchr(path, '/') + 1,
                  view, differing, expected.width * expected.height);
    framebuffer_free(&expected);
    framebuffer_free(&picture);
    return differing;
}

// Compares all views before it fails, so that it prints the figures of all views.
static void check_oracle(const char *path, Comparing comparing)
{
    Stored stored;
    uint32_t differing = 0;
    stored_open(&stored, path);
    for (uint32_t view = 1; view <= stored.scene.viewpoints.count; view++)
        differing += view_differences(&stored, path, view, &comparing);
    stored_close(&stored);
    assert_int_equal(differing, 0);
}

static const Comparing all = {1, ROUNDED}, meshes = {MESH_STEP, ROUNDED};

static bool has_models(void)
{
    if (access(CLRT_SOURCE_FOLDER "/scenes/models/creature.ply", R_OK) == 0)
        return true;
    print_message("skipped: scenes/models was not made (CLRT_WITH_MODELS)\n");
    return false;
}

static void every_pixel_of_small_scenes_is_the_oracles(void **state)
{
    (void)state;
    check_oracle(CLRT_SOURCE_FOLDER "/scenes/silhouette.scn", all);
    check_oracle(CLRT_SOURCE_FOLDER "/scenes/matte.scn", all);
    check_oracle(CLRT_SOURCE_FOLDER "/scenes/blinn_phong.scn", all);
    check_oracle(CLRT_SOURCE_FOLDER "/scenes/reflections.scn", all);
    check_oracle(CLRT_SOURCE_FOLDER "/scenes/simple.scn", all);
    check_oracle(CLRT_SOURCE_FOLDER "/tests/image/every_feature.scn", all);
}

static void every_compared_pixel_of_meshes_is_the_oracles(void **state)
{
    (void)state;
    if (!has_models())
        return;
    check_oracle(CLRT_SOURCE_FOLDER "/scenes/creature.scn", meshes);
    check_oracle(CLRT_SOURCE_FOLDER "/scenes/figure.scn", meshes);
}

static void every_compared_pixel_of_the_courses_scenes_is_the_oracles(void **state)
{
    static const char *const names[] = {"reflections.scn", "cow.scn"};
    (void)state;
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        char path[COURSE_PATH_SIZE];
        course_path(path, "scenes", names[i]);
        if (course_has(path))
            check_oracle(path, meshes);
    }
}

static void every_pixel_of_unusual_scenes_is_the_oracles(void **state)
{
    char path[INLINE_PATH_SIZE];
    (void)state;
    for (int scene = 0; scene < INLINE_COUNT; scene++) {
        inline_scenes_path(&inline_scenes, (InlineScene)scene, path);
        check_oracle(path, all);
    }
}

// share is the number of pixels in 100,000 of a view that may differ in fp32 by more than an 8-bit
// step.
static void check_fp32(const char *name, uint64_t share)
{
    char path[256];
    Error error = {0};
    Scene scene = {0};
    bool holds = true;
    snprintf(path, sizeof path, CLRT_SOURCE_FOLDER "/scenes/%s.scn", name);
    if (!scn_load(&scene, path, ply_parse, &error))
        fail_msg("%s", error.text);
    for (uint32_t view = 1; view <= scene.viewpoints.count; view++) {
        Framebuffer one, other;
        rendered(&one, path, view, PRECISION_FP32);
        rendered(&other, path, view, PRECISION_FP64);
        const Comparing comparing = {1, 1.0f / 255};
        const uint64_t differing = count_differing(&one, &other, &comparing);
        const uint64_t pixels = (uint64_t)one.width * one.height;
        print_message("%s view %u: fp32 differs in %llu of %llu pixels\n", name, view,
                      (unsigned long long)differing, (unsigned long long)pixels);
        holds = holds && differing * 100000 <= share * pixels;
        framebuffer_free(&one);
        framebuffer_free(&other);
    }
    scene_free(&scene);
    assert_true(holds);
}

static void fp32_differs_in_few_pixels(void **state)
{
    (void)state;
    check_fp32("silhouette", 0);
    check_fp32("matte", 0);
    check_fp32("blinn_phong", 0);
    check_fp32("reflections", 1);
    check_fp32("simple", 1);
}

// Mirrors that face each other amplify every rounding. Only the showcase has many such mirrors.
static void fp32_differs_in_few_pixels_of_meshes(void **state)
{
    (void)state;
    if (!has_models())
        return;
    check_fp32("creature", 2);
    check_fp32("figure", 5);
    check_fp32("showcase", 100);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_pixel_of_small_scenes_is_the_oracles),
        cmocka_unit_test(every_compared_pixel_of_meshes_is_the_oracles),
        cmocka_unit_test(every_compared_pixel_of_the_courses_scenes_is_the_oracles),
        cmocka_unit_test(every_pixel_of_unusual_scenes_is_the_oracles),
        cmocka_unit_test(fp32_differs_in_few_pixels),
        cmocka_unit_test(fp32_differs_in_few_pixels_of_meshes),
    };
    return cmocka_run_group_tests(tests, inline_scenes_set_up, inline_scenes_tear_down);
}
