// SPDX-License-Identifier: MIT
// Makes OpenCL refuse a launch while the test holds the previous launch back. clrt must wait for
// the previous launch before it frees memory.
#include "image/rendered.h"

#include <dlfcn.h>
#include <string.h>

#include "unit/cmocka_all.h"

#define LAUNCH_ITEMS 4096 // work-items of all launches but the last, as in host/render/sampler.c

static cl_event gate, held_launch; // NULL before the launch
static bool is_released;
static cl_int status_at_release;

static cl_event make_gate(cl_command_queue queue)
{
    cl_context context;
    clGetCommandQueueInfo(queue, CL_QUEUE_CONTEXT, sizeof context, &context, NULL);
    return clCreateUserEvent(context, NULL);
}

// These three functions override functions of OpenCL.
cl_int clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions,
                              const size_t *offset, const size_t *grid, const size_t *group,
                              cl_uint count, const cl_event *awaited, cl_event *event)
{
    static __typeof__(clEnqueueNDRangeKernel) *real;
    if (real == NULL)
        *(void **)&real = dlsym(RTLD_NEXT, "clEnqueueNDRangeKernel");
    if (held_launch != NULL)
        return CL_OUT_OF_RESOURCES;
    if (dimensions != 1 || grid[0] < LAUNCH_ITEMS)
        return real(queue, kernel, dimensions, offset, grid, group, count, awaited, event);
    gate = make_gate(queue);
    const cl_int status = real(queue, kernel, dimensions, offset, grid, group, 1, &gate, event);
    held_launch = *event;
    clRetainEvent(held_launch);
    return status;
}

static void open_gate(void)
{
    if (gate != NULL)
        clSetUserEventStatus(gate, CL_COMPLETE);
    gate = NULL;
}

cl_int clFinish(cl_command_queue queue)
{
    static __typeof__(clFinish) *real;
    if (real == NULL)
        *(void **)&real = dlsym(RTLD_NEXT, "clFinish");
    open_gate();
    return real(queue);
}

cl_int clReleaseMemObject(cl_mem memory)
{
    static __typeof__(clReleaseMemObject) *real;
    if (real == NULL)
        *(void **)&real = dlsym(RTLD_NEXT, "clReleaseMemObject");
    if (held_launch != NULL && !is_released) {
        clGetEventInfo(held_launch, CL_EVENT_COMMAND_EXECUTION_STATUS, sizeof status_at_release,
                       &status_at_release, NULL);
        is_released = true;
        open_gate();
    }
    return real(memory);
}

// The previous launch writes to host memory that clrt frees next.
TEST(after_a_refused_launch_the_one_before_it_is_awaited)
{
    PictureRequest request = picture_request(CLRT_SOURCE_FOLDER "/scenes/reflections.scn", 1);
    request.width = request.height = 1024;
    request.contrast = 0.1f;
    FREED_BY(framebuffer_free) Framebuffer picture;
    Error error = {0};
    assert_false(picture_render(&picture, &request, &error));
    assert_non_null(strstr(error.text, "run the kernel trace_samples"));
    assert_true(is_released);
    assert_int_equal(status_at_release, CL_COMPLETE);
}
