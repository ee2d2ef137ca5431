// SPDX-License-Identifier: MIT
// Compares the renderer with the fp64 oracle, in all views of the course's scenes and of unusual
// scenes. A few pixels may differ if the oracle explains why (oracle_explains). Only every step-th
// pixel of every step-th row is compared; CLRT_FULL=1 in the environment compares all.
#include "image/comparison.h"
#include "image/course.h"
#include "image/rendered.h"
#include "image/unusual_scenes.h"
#include "unit/cmocka_all.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// The number of pixels of a 512 x 512 picture that may differ.
#define LIMIT 30

// Comparing all pixels would take minutes.
#define STEP             3
#define COURSE_MESH_STEP 6

static bool view_agrees(const Oracle *oracle, const char *path, uint32_t view, uint32_t step)
{
    char name[64];
    const Scene *scene = oracle->scene;
    Error error = {0};
    PictureRequest request = picture_request(path, view);
    request.scene = scene;
    request.has_last_tree = view > 1;
    FREED_BY(framebuffer_free) Framebuffer picture = rendered(&request), expected = {0};
    const OracleView rays = oracle_view(oracle, &scene->viewpoints.data[view - 1], scene->width,
                                        scene->height, scene->max_level);
    rendered_require(oracle_draw(&rays, 1, step, &expected, &error), &error);
    const Comparison comparison = comparison_make(&rays, &picture, &expected, step);
    snprintf(name, sizeof name, "%s view %u", strrchr(path, '/') + 1, view);
    comparison_print(&comparison, name);
    return comparison.unexplained == 0 &&
           comparison.differing <= comparison_allowance(&comparison, LIMIT);
}

// Compares all views before it fails, so that it prints the figures of all views.
static void check(const char *path, uint32_t step)
{
    Error error = {0};
    FREED_BY(scene_free) Scene scene = rendered_scene(path);
    FREED_BY(oracle_free) Oracle oracle = {0};
    bool agrees = true;
    if (getenv("CLRT_FULL") != NULL)
        step = 1;
    rendered_require(oracle_make(&oracle, &scene, &error), &error);
    for (uint32_t view = 1; view <= scene.viewpoints.count; view++)
        agrees = view_agrees(&oracle, path, view, step) && agrees;
    assert_true(agrees);
}

static void check_course(const char *name, uint32_t step)
{
    char path[COURSE_PATH_SIZE];
    course_path(path, name);
    if (course_has(path))
        check(path, step);
}

TEST(the_courses_scenes_are_drawn_as_the_oracle_does)
{
    check_course("silhouette.scn", STEP);
    check_course("matte.scn", STEP);
    check_course("blinn_phong.scn", STEP);
    check_course("reflections.scn", STEP);
    check_course("simple.scn", STEP);
    check_course("cow.scn", COURSE_MESH_STEP);
    check_course("buddha.scn", COURSE_MESH_STEP);
}

TEST(unusual_scenes_are_drawn_as_the_oracle_does)
{
    for (size_t scene = 0; scene < UNUSUAL_COUNT; scene++)
        check(unusual_scenes[scene], STEP);
    check(CLRT_SOURCE_FOLDER "/tests/image/every_feature.scn", 1);
    check(CLRT_SOURCE_FOLDER "/tests/image/painted.scn", 1);
    check(CLRT_SOURCE_FOLDER "/tests/image/glass.scn", 1);
}
