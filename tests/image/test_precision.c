// SPDX-License-Identifier: MIT
// Compares fp64 pictures with the oracle, which traces the same stored numbers in fp64 by other
// methods. Compares fp32 pictures with fp64 pictures, which differ by rounding.
#include "image/comparison.h"
#include "image/course.h"
#include "image/form.h"
#include "image/rendered.h"
#include "image/unusual_scenes.h"
#include "oracle/stored.h"
#include "scene/camera.h"
#include "unit/cmocka_all.h"

#include <string.h>

// The largest difference by rounding: two float steps below 1, plus two steps of 2^-32. clrt rounds
// colors to multiples of 2^-32 before it stores floats.
#define ROUNDED 0x1.01p-23f

#define FP64 (&form_all[FORMS_FP32])

// A picture's width and height are 1 / `part` of the scene's width and height. Every step-th pixel
// of every step-th row is compared. The oracle would take minutes for all pixels of a mesh.
typedef struct {
    uint32_t part, step;
} Share;

static const Share small = {3, 1}, meshes = {4, 6}, unusual = {2, 1};

// All views of a scene share its tree, so the first view must be drawn first.
static PictureRequest request_of(const char *path, const Scene *scene, uint32_t view, uint32_t part)
{
    PictureRequest request = picture_request(path, view);
    request.scene = scene;
    request.has_last_tree = view > 1;
    request.width = scene->width / part;
    request.height = scene->height / part;
    return request;
}

// Returns the number of pixels that differ by more than the tolerance. expected contains every
// step-th pixel of every step-th row.
static uint32_t count_differing(const Framebuffer *picture, const Framebuffer *expected,
                                uint32_t step, float tolerance)
{
    uint32_t differing = 0;
    for (uint32_t y = 0; y < expected->height; y++)
        for (uint32_t x = 0; x < expected->width; x++) {
            const float *one = picture->pixels[(size_t)y * step * picture->width + x * step];
            const float *other = expected->pixels[(size_t)y * expected->width + x];
            differing += !(color_difference(one, other) <= tolerance);
        }
    return differing;
}

// Returns the number of pixels that differ from the oracle's picture. `stored` traces the numbers
// that the device stores for the scene.
static uint32_t view_differences(const Oracle *stored, const Normalization *normalization,
                                 const PictureRequest *request, uint32_t step)
{
    Error error = {0};
    const CameraData camera = camera_make(&stored->scene->viewpoints.data[request->view - 1],
                                          normalization, request->width, request->height, 1);
    const OracleView rays = stored_view(stored, &camera, request->width, request->height);
    FREED_BY(framebuffer_free) Framebuffer picture = rendered(request), expected = {0};
    rendered_require(oracle_draw(&rays, 1, step, &expected, &error), &error);
    const uint32_t differing = count_differing(&picture, &expected, step, ROUNDED);
    print_message("%s view %u: %u of %u pixels differ from the oracle's\n",
                  strrchr(request->scene_path, '/') + 1, request->view, differing,
                  expected.width * expected.height);
    return differing;
}

// Compares all views before it fails, so that it prints the figures of all views.
static void check_oracle(const char *path, Share share)
{
    Error error = {0};
    uint32_t differing = 0;
    FREED_BY(scene_free) Scene scene = rendered_scene(path), rounded = rendered_scene(path);
    FREED_BY(oracle_free) Oracle stored = {0};
    const Normalization normalization = normalization_of(&scene);
    rendered_require(stored_round(&rounded, &normalization, &error) &&
                         oracle_make(&stored, &rounded, &error),
                     &error);
    for (uint32_t view = 1; view <= scene.viewpoints.count; view++) {
        const PictureRequest request =
            rendered_in_form(request_of(path, &scene, view, share.part), FP64);
        differing += view_differences(&stored, &normalization, &request, share.step);
    }
    assert_int_equal(differing, 0);
}

TEST(every_pixel_of_small_scenes_is_the_oracles)
{
    check_oracle(CLRT_SOURCE_FOLDER "/scenes/silhouette.scn", small);
    check_oracle(CLRT_SOURCE_FOLDER "/scenes/matte.scn", small);
    check_oracle(CLRT_SOURCE_FOLDER "/scenes/blinn_phong.scn", small);
    check_oracle(CLRT_SOURCE_FOLDER "/scenes/reflections.scn", small);
    check_oracle(CLRT_SOURCE_FOLDER "/scenes/simple.scn", small);
    check_oracle(CLRT_SOURCE_FOLDER "/tests/image/every_feature.scn", (Share){1, 1});
    check_oracle(CLRT_SOURCE_FOLDER "/tests/image/painted.scn", (Share){1, 1});
}

TEST(every_compared_pixel_of_meshes_is_the_oracles)
{
    if (!models_are_made())
        return;
    check_oracle(CLRT_SOURCE_FOLDER "/scenes/creature.scn", meshes);
    check_oracle(CLRT_SOURCE_FOLDER "/scenes/figure.scn", meshes);
}

TEST(every_compared_pixel_of_the_courses_scenes_is_the_oracles)
{
    static const char *const names[] = {"reflections.scn", "cow.scn"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        char path[COURSE_PATH_SIZE];
        course_path(path, names[i]);
        if (course_has(path))
            check_oracle(path, meshes);
    }
}

TEST(every_pixel_of_unusual_scenes_is_the_oracles)
{
    for (size_t scene = 0; scene < UNUSUAL_COUNT; scene++)
        check_oracle(unusual_scenes[scene], unusual);
}

// In at most `share` of 100,000 pixels, fp32 and fp64 may differ by more than an 8-bit step.
// Mirrors that face each other amplify every rounding. Only the showcase has many such mirrors.
TEST(fp32_differs_in_few_pixels)
{
    static const struct {
        const char *path;
        uint64_t share;
        bool needs_models;
    } cases[] = {{CLRT_SOURCE_FOLDER "/scenes/silhouette.scn", 0, false},
                 {CLRT_SOURCE_FOLDER "/scenes/matte.scn", 0, false},
                 {CLRT_SOURCE_FOLDER "/scenes/blinn_phong.scn", 0, false},
                 {CLRT_SOURCE_FOLDER "/scenes/reflections.scn", 1, false},
                 {CLRT_SOURCE_FOLDER "/scenes/simple.scn", 1, false},
                 {CLRT_SOURCE_FOLDER "/scenes/creature.scn", 2, true},
                 {CLRT_SOURCE_FOLDER "/scenes/figure.scn", 5, true},
                 {CLRT_SOURCE_FOLDER "/scenes/showcase.scn", 100, true}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        uint64_t differing = 0, pixels = 0;
        if (cases[i].needs_models && !models_are_made())
            continue;
        FREED_BY(scene_free) Scene scene = rendered_scene(cases[i].path);
        for (uint32_t view = 1; view <= scene.viewpoints.count; view++) {
            const uint32_t part = cases[i].needs_models ? 4 : 2;
            const PictureRequest request = request_of(cases[i].path, &scene, view, part),
                                 one = rendered_in_form(request, &form_all[0]);
            PictureRequest other = rendered_in_form(request, FP64);
            other.has_last_tree = true;
            FREED_BY(framebuffer_free)
            Framebuffer first = rendered(&one), second = rendered(&other);
            differing += count_differing(&first, &second, 1, 1.0f / 255);
            pixels += (uint64_t)first.width * first.height;
        }
        print_message("%s: fp32 differs in %llu of %llu pixels\n", cases[i].path,
                      (unsigned long long)differing, (unsigned long long)pixels);
        assert_true(differing * 100000 <= cases[i].share * pixels);
    }
}
