// SPDX-License-Identifier: MIT
// Each buffer of a call fails once. The library must report the failure, succeed when the caller
// retries, and release all buffers with the renderer.
#include "library/faults.h"
#include "library/filled.h"
#include "library/program.h"

#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <dlfcn.h>

static __typeof__(clCreateBuffer) *drivers_create;
static __typeof__(clReleaseMemObject) *drivers_release;
static int buffers;   // that exist
static int countdown; // the call of clCreateBuffer that fails, counted from 1; 0: none

SET_UP(find_drivers_functions)
{
    *(void **)&drivers_create = dlsym(RTLD_NEXT, "clCreateBuffer");
    *(void **)&drivers_release = dlsym(RTLD_NEXT, "clReleaseMemObject");
    return drivers_create == NULL || drivers_release == NULL;
}

#pragma GCC visibility push(default)

// libclrt calls these functions instead of the functions of the driver.
cl_mem clCreateBuffer(cl_context context, cl_mem_flags flags, size_t size, void *host,
                      cl_int *status)
{
    if (countdown > 0 && --countdown == 0) {
        *status = CL_MEM_OBJECT_ALLOCATION_FAILURE;
        return NULL;
    }
    buffers++;
    return drivers_create(context, flags, size, host, status);
}

cl_int clReleaseMemObject(cl_mem buffer)
{
    buffers--;
    return drivers_release(buffer);
}

#pragma GCC visibility pop

typedef bool Call(ClrtRenderer *renderer, const ClrtScene *scene, ClrtError *error);

static bool draw(ClrtRenderer *renderer, const ClrtScene *scene, ClrtError *error)
{
    static float rgb[3 * 16 * 16];
    const ClrtPicture picture = {.size = sizeof picture, .width = 16, .height = 16};
    return clrt_render(renderer, scene, &picture, rgb, error);
}

static bool trace(ClrtRenderer *renderer, const ClrtScene *scene, ClrtError *error)
{
    static const double origin[3] = {0, 0, -9};
    uint8_t occluded;
    const ClrtRays rays = {.size = sizeof rays, .count = 1, .origins = origin};
    return clrt_occluded(renderer, scene, &rays, &occluded, error);
}

// Returns the number of buffers that the call makes.
static int fail_each_buffer(const ClrtScene *scene, Call *call)
{
    bool ok = false;
    int count = 0;
    while (!ok) {
        ClrtError error = faults_blank();
        ClrtRenderer *renderer = program_renderer(1);
        assert_non_null(renderer);
        countdown = ++count;
        ok = call(renderer, scene, &error);
        if (!ok)
            faults_assert(ok, &error, CLRT_DEVICE, "");
        countdown = 0;
        assert_true(call(renderer, scene, NULL));
        clrt_renderer_free(renderer);
        assert_int_equal(buffers, 0);
    }
    return count - 1;
}

TEST(a_renderer_survives_the_failure_of_each_buffer)
{
    ClrtScene *scene = filled_make();
    assert_true(fail_each_buffer(scene, draw) > 2);
    assert_true(fail_each_buffer(scene, trace) > 5);
    clrt_scene_free(scene);
}
