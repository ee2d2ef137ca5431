// SPDX-License-Identifier: MIT
// Several threads create renderers and draw concurrently. The process makes no earlier call
// of OpenCL, so that the drivers initialize in the threads.
#include "library/filled.h"
#include "library/program.h"
#include "unit/cmocka_all.h"

#include <pthread.h>
#include <stdlib.h>

#define WIDTH  200
#define HEIGHT 150

static const ClrtPicture picture = {
    .size = sizeof picture, .width = WIDTH, .height = HEIGHT, .samples = 2, .max_level = 5};

typedef struct {
    pthread_t thread;
    pthread_barrier_t *start;
    const ClrtScene *scene;
    const float *expected;
    bool agrees;
} Job;

#define JOBS 4

static void *draw_thrice(void *context)
{
    Job *job = context;
    pthread_barrier_wait(job->start);
    ClrtRenderer *own = program_renderer(1);
    job->agrees = own != NULL;
    for (int round = 0; round < 3 && job->agrees; round++)
        job->agrees = program_agrees(own, job->scene, &picture, job->expected);
    clrt_renderer_free(own);
    return NULL;
}

// Draws in all threads concurrently. Even threads draw the first scene, odd threads the second.
static void draw_at_once(ClrtScene *scenes[2], float *expected[2])
{
    Job jobs[JOBS];
    pthread_barrier_t start;
    pthread_barrier_init(&start, NULL, JOBS);
    for (int i = 0; i < JOBS; i++) {
        jobs[i] = (Job){.start = &start, .scene = scenes[i % 2], .expected = expected[i % 2]};
        assert_int_equal(pthread_create(&jobs[i].thread, NULL, draw_thrice, &jobs[i]), 0);
    }
    for (int i = 0; i < JOBS; i++)
        pthread_join(jobs[i].thread, NULL);
    for (int i = 0; i < JOBS; i++)
        assert_true(jobs[i].agrees);
    pthread_barrier_destroy(&start);
}

TEST(several_threads_create_renderers_and_draw_concurrently)
{
    const char *options = "--aa=2 --max-level 5";
    ClrtScene *scenes[2] = {filled_make(),
                            clrt_scene_load(program_file("scenes/reflections.scn"), NULL, NULL)};
    float *expected[2] = {
        program_draw(program_file("tests/library/filled.scn"), options, WIDTH, HEIGHT),
        program_draw(program_file("scenes/reflections.scn"), options, WIDTH, HEIGHT)};
    assert_non_null(scenes[1]);
    draw_at_once(scenes, expected);
    for (int i = 0; i < 2; i++) {
        free(expected[i]);
        clrt_scene_free(scenes[i]);
    }
}
