// SPDX-License-Identifier: MIT
// Several threads create renderers and draw concurrently. The process makes no earlier call of
// OpenCL, so that the drivers initialize in the threads. Then tests how a renderer divides rays
// among threads.
#include "library/filled.h"
#include "library/program.h"
#include "unit/cmocka_all.h"

#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <dlfcn.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

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

#define RAYS 200000

static atomic_size_t launched; // work-items of all launches
static __typeof__(clEnqueueNDRangeKernel) *drivers_function;

SET_UP(find_drivers_function)
{
    *(void **)&drivers_function = dlsym(RTLD_NEXT, "clEnqueueNDRangeKernel");
    return drivers_function == NULL;
}

#pragma GCC visibility push(default)

// libclrt calls this function instead of the function of the driver.
cl_int clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions,
                              const size_t *offset, const size_t *items, const size_t *group,
                              cl_uint wait_count, const cl_event *waits, cl_event *event)
{
    launched += items[0];
    return drivers_function(queue, kernel, dimensions, offset, items, group, wait_count, waits,
                            event);
}

#pragma GCC visibility pop

static double origins[RAYS][3];

// Returns rays from different points toward the scene.
static ClrtRays many_rays(void)
{
    for (size_t i = 0; i < RAYS; i++) {
        origins[i][0] = (double)(i * 7919 % 1000) * 0.004 - 2;
        origins[i][1] = (double)(i * 104729 % 1000) * 0.004 - 2;
        origins[i][2] = -9;
    }
    return (ClrtRays){.size = sizeof(ClrtRays), .count = RAYS, .origins = origins[0]};
}

// In packets, a work-item traces 64 rays. PoCL divides work-items among its threads in advance, so
// work-items without rays would leave most rays to one thread.
TEST(work_items_of_packets_have_64_rays)
{
    static uint8_t occluded[RAYS];
    const ClrtSettings settings = {
        .size = sizeof settings, .device = "cpu", .kernel = CLRT_KERNEL_PACKET};
    ClrtScene *scene = filled_make();
    ClrtRenderer *renderer = clrt_renderer_create(&settings, NULL);
    const ClrtRays rays = many_rays();
    assert_non_null(renderer);
    launched = 0;
    assert_true(clrt_occluded(renderer, scene, &rays, occluded, NULL));
    assert_in_range(launched, RAYS / 64, RAYS / 64 + RAYS / 1000);
    clrt_renderer_free(renderer);
    clrt_scene_free(scene);
}

TEST(the_first_of_several_faulty_rays_is_reported)
{
    static uint32_t starts[RAYS], primitives[RAYS];
    ClrtScene *scene = filled_make();
    ClrtRenderer *renderer = program_renderer(0);
    ClrtRays rays = many_rays();
    const ClrtHits hits = {.size = sizeof hits, .primitives = primitives};
    ClrtError error;
    for (size_t i = 0; i < RAYS; i++)
        starts[i] = i % 5000 == 4321 ? 1000000 : CLRT_NOTHING;
    rays.starts = starts;
    for (int round = 0; round < 5; round++) {
        assert_false(clrt_trace(renderer, scene, &rays, &hits, &error));
        assert_non_null(strstr(error.text, "ray 4321 starts on primitive 1000000 of"));
    }
    clrt_renderer_free(renderer);
    clrt_scene_free(scene);
}
