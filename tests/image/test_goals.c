// SPDX-License-Identifier: MIT
// Errors that were asked for are held, at a fraction of what samples everywhere would cost.
#include "image/rendered.h"
#include "unit/cmocka_all.h"

#include <stdio.h>

#define SCENES CLRT_SOURCE_FOLDER "/scenes/"
#define SIDE   200

static const struct {
    const char *path;
    uint32_t view;
} pictures[] = {
    {SCENES "simple.scn", 1},      {SCENES "simple.scn", 4},
    {SCENES "reflections.scn", 1}, {SCENES "reflections.scn", 3},
    {SCENES "blinn_phong.scn", 2}, {SCENES "matte.scn", 1},
    {SCENES "silhouette.scn", 5},  {SCENES "creature.scn", 1},
    {SCENES "creature.scn", 3},    {CLRT_SOURCE_FOLDER "/tests/image/every_feature.scn", 1}};
#define PICTURE_COUNT (sizeof pictures / sizeof pictures[0])

static const double goals[] = {0.02, 0.01, 0.005, 0.002};
#define GOAL_COUNT (sizeof goals / sizeof goals[0])

// Returns whether the error is within a tenth of the goal, and adds the samples that it took.
static bool holds(const PictureRequest *request, double goal, const Framebuffer *reference,
                  uint64_t *samples)
{
    uint64_t count;
    PictureRequest wanted = *request;
    wanted.error_goal = goal;
    wanted.sample_count = &count;
    Framebuffer picture = rendered(&wanted);
    const double reached = rendered_error(&picture, reference);
    framebuffer_free(&picture);
    *samples += count;
    if (reached > 1.1 * goal)
        print_message("%s, view %u: %g instead of %g\n", request->scene_path, request->view,
                      reached, goal);
    return reached <= 1.1 * goal;
}

// The fewest samples of a grid, along a side, whose error is no larger than the goal.
static uint32_t side_that_holds(const PictureRequest *request, double goal,
                                const Framebuffer *reference)
{
    for (uint32_t side = 1;; side++) {
        PictureRequest uniform = *request;
        uniform.samples = side;
        Framebuffer picture = rendered(&uniform);
        const double reached = rendered_error(&picture, reference);
        framebuffer_free(&picture);
        if (reached <= goal)
            return side;
    }
}

static void errors_asked_for_are_held_but_for_one_of_forty(void **state)
{
    (void)state;
    unsigned held = 0;
    uint64_t samples[GOAL_COUNT] = {0}, uniform[GOAL_COUNT] = {0};
    for (size_t i = 0; i < PICTURE_COUNT; i++) {
        PictureRequest request = picture_request(pictures[i].path, pictures[i].view);
        request.width = request.height = SIDE;
        PictureRequest many = request;
        many.samples = 20;
        Framebuffer reference = rendered(&many);
        for (size_t goal = 0; goal < GOAL_COUNT; goal++) {
            const uint32_t side = side_that_holds(&request, goals[goal], &reference);
            held += holds(&request, goals[goal], &reference, &samples[goal]);
            uniform[goal] += (uint64_t)SIDE * SIDE * side * side;
        }
        framebuffer_free(&reference);
    }
    assert_true(held + 1 >= PICTURE_COUNT * GOAL_COUNT);
    for (size_t goal = 0; goal < GOAL_COUNT; goal++) {
        print_message("%g: %.1f times fewer samples\n", goals[goal],
                      (double)uniform[goal] / (double)samples[goal]);
        assert_true(2 * samples[goal] <= uniform[goal]);
        assert_true(goals[goal] > 0.005 || 6 * samples[goal] <= uniform[goal]);
        assert_true(goals[goal] > 0.002 || 18 * samples[goal] <= uniform[goal]);
    }
}

static uint64_t samples_for(const char *path, double goal)
{
    uint64_t count = 0;
    PictureRequest request = picture_request(path, 1);
    request.width = request.height = SIDE;
    request.error_goal = goal;
    request.sample_count = &count;
    Framebuffer picture = rendered(&request);
    framebuffer_free(&picture);
    return count;
}

// With one, an error of 0.0229 is estimated.
static void no_more_than_one_sample_a_pixel_is_taken_where_that_does(void **state)
{
    (void)state;
    assert_int_equal(samples_for(SCENES "simple.scn", 0.025), SIDE * SIDE);
    assert_true(samples_for(SCENES "simple.scn", 0.022) > SIDE * SIDE);
}

static void parts_smaller_than_a_pixel_are_looked_for_whatever_the_error(void **state)
{
    (void)state;
    assert_true(samples_for(CLRT_SOURCE_FOLDER "/tests/bench/cables.scn", 0.5) > SIDE * SIDE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(errors_asked_for_are_held_but_for_one_of_forty),
        cmocka_unit_test(no_more_than_one_sample_a_pixel_is_taken_where_that_does),
        cmocka_unit_test(parts_smaller_than_a_pixel_are_looked_for_whatever_the_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
