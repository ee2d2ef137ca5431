// SPDX-License-Identifier: MIT
// Compares the renderer with the course's pictures. They come from a float tracer with another
// triangle test, so a few pixels on edges differ. The oracle must find the edge at each of them.
#include "image/comparison.h"
#include "image/course.h"
#include "image/picture.h"
#include "image/read_exr.h"
#include "scene/scn.h"
#include "unit/cmocka_all.h"

typedef struct {
    Framebuffer picture, reference;
    Scene scene;
    Oracle oracle;
} Trial;

static bool trial_make(Trial *trial, const char *scene_name, uint32_t samples, Error *error)
{
    char path[COURSE_PATH_SIZE];
    course_path(path, "scenes", scene_name);
    PictureRequest request = picture_request(path, 1);
    request.samples = samples;
    return picture_render(&trial->picture, &request, error) &&
           scn_load(&trial->scene, path, ply_parse, error) &&
           oracle_make(&trial->oracle, &trial->scene, error) &&
           framebuffer_make(&trial->reference, trial->picture.width, trial->picture.height, error);
}

static void trial_free(Trial *trial)
{
    framebuffer_free(&trial->reference);
    oracle_free(&trial->oracle);
    scene_free(&trial->scene);
    framebuffer_free(&trial->picture);
}

static void check(const char *scene_name, const char *reference_name, uint32_t samples,
                  uint32_t limit)
{
    char path[COURSE_PATH_SIZE];
    Error error = {0};
    FREED_BY(trial_free) Trial trial = {0};
    course_path(path, "references", reference_name);
    if (!course_has(path))
        return;
    if (!trial_make(&trial, scene_name, samples, &error))
        fail_msg("%s", error.text);
    const Framebuffer *picture = &trial.picture;
    const ExrPicture reference = {(int)picture->width, (int)picture->height,
                                  trial.reference.pixels[0]};
    if (!read_exr(path, &reference, error.text, sizeof error.text))
        fail_msg("%s", error.text);
    const OracleView view = oracle_view(&trial.oracle, &trial.scene.viewpoints.data[0],
                                        picture->width, picture->height, trial.scene.max_level);
    const Comparison comparison = comparison_make(&view, picture, &trial.reference, 1);
    comparison_print(&comparison, reference_name);
    assert_int_equal(comparison.unexplained, 0);
    assert_true(comparison.differing <= limit);
}

TEST(silhouettes_are_the_courses)
{
    check("silhouette.scn", "silhouette.exr", 1, 30);
}

TEST(matte_surfaces_are_the_courses)
{
    check("matte.scn", "matte.exr", 1, 30);
}

TEST(highlights_are_the_courses)
{
    check("blinn_phong.scn", "blinn_phong.exr", 1, 30);
}

TEST(reflections_are_the_courses)
{
    check("reflections.scn", "reflections.exr", 1, 30);
}

TEST(four_samples_a_pixel_are_the_courses)
{
    check("reflections.scn", "reflections-aa.exr", 2, 120);
}
