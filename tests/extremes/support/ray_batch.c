// SPDX-License-Identifier: MIT
// All launches have the same grid and work-group size, because PoCL may compile a kernel again for
// other sizes. Compiling needs the cache's lock, which only ray_batch_open holds.
#include "ray_batch.h"

#include "base/file.h"
#include "check.h"
#include "image/form.h"
#include "image/shared_cache.h"

#include <math.h>
#include <string.h>

#define BATCH_RAYS 65536

// The number of lanes of kernels with wide nodes, if form_choice names none.
#define BATCH_LANES 16

static const char *const kernel_names[BATCH_TASKS] = {"batch_nearest", "batch_blocked",
                                                      "batch_leave"};

static void require_success(cl_int status, const char *attempt)
{
    Error error = {0};
    require(cl_succeeded(status, attempt, &error), &error);
}

// Returns a buffer with a copy of data, or an uninitialized buffer if data is NULL.
static cl_mem make_buffer(const RayBatch *batch, const void *data, size_t size)
{
    cl_int status;
    const cl_mem_flags flags = CL_MEM_READ_WRITE | (data != NULL ? CL_MEM_COPY_HOST_PTR : 0);
    const cl_mem buffer = clCreateBuffer(batch->device.context, flags, size, (void *)data, &status);
    require_success(status, "make a buffer");
    return buffer;
}

static void set_array(RayBatch *batch, int place, const FlatArray *array)
{
    if (batch->arrays[place] != NULL)
        clReleaseMemObject(batch->arrays[place]);
    const bool is_empty = array->bytes == 0;
    batch->arrays[place] =
        make_buffer(batch, is_empty ? NULL : array->data, is_empty ? 64 : array->bytes);
}

// Runs a kernel over the first count rays in the buffer.
static bool launch(const RayBatch *batch, BatchTask task, cl_uint count, Error *error)
{
    const bool is_wide = batch->choice.nodes == NODES_WIDE;
    const size_t grid = is_wide ? BATCH_RAYS / batch->choice.lanes : BATCH_RAYS;
    const size_t group = is_wide ? 4 : 64;
    cl_kernel kernel = batch->kernels[task];
    cl_uint place = 0;
    cl_int status = clSetKernelArg(kernel, place++, sizeof batch->frame, &batch->frame);
    for (int array = 0; array < FLAT_ARRAYS; array++)
        status |= clSetKernelArg(kernel, place++, sizeof(cl_mem), &batch->arrays[array]);
    status |= clSetKernelArg(kernel, place++, sizeof(cl_mem), &batch->rays);
    status |= clSetKernelArg(kernel, place++, sizeof count, &count);
    status |= clSetKernelArg(kernel, place++, sizeof(cl_mem), &batch->outward);
    status |= clSetKernelArg(kernel, place++, sizeof(cl_mem), &batch->hits);
    if (!cl_succeeded(status, "set the arguments of a kernel", error))
        return false;
    status =
        clEnqueueNDRangeKernel(batch->device.queue, kernel, 1, NULL, &grid, &group, 0, NULL, NULL);
    return cl_succeeded(status, "run a kernel", error);
}

static bool make_kernels(void *context, Error *error)
{
    RayBatch *batch = context;
    for (int task = 0; task < BATCH_TASKS; task++) {
        cl_int status;
        batch->kernels[task] = clCreateKernel(batch->program.handle, kernel_names[task], &status);
        if (!cl_succeeded(status, kernel_names[task], error) ||
            !launch(batch, (BatchTask)task, 0, error))
            return false;
    }
    return cl_succeeded(clFinish(batch->device.queue), "finish the first runs", error);
}

void ray_batch_open(RayBatch *batch, const char *kernel_folder, const char *options)
{
    Error error = {0};
    File file = {0};
    const Cache *cache = shared_cache();
    *batch =
        (RayBatch){.is_changed = kernel_folder != NULL || options != NULL, .choice = form_choice()};
    if (batch->choice.nodes == NODES_WIDE && batch->choice.lanes == 0)
        batch->choice.lanes = BATCH_LANES;
    require(device_open(&batch->device, getenv("CLRT_DEVICE"), &error) &&
                file_read(&file, CLRT_SOURCE_FOLDER "/tests/extremes/support/ray_batch.cl", &error),
            &error);
    batch->rays = make_buffer(batch, NULL, BATCH_RAYS * sizeof(TestRay));
    batch->hits = make_buffer(batch, NULL, BATCH_RAYS * sizeof(TestHit));
    batch->outward = make_buffer(batch, NULL, BATCH_RAYS * sizeof(float[3]));
    ray_batch_upload(batch, &(FlatScene){.layout = batch->choice.nodes});
    const KernelEntry entry = {.source = file.bytes};
    const ProgramSource source = {
        .device = &batch->device,
        .cache = cache,
        .kernel_folder = kernel_folder != NULL ? kernel_folder : getenv("CLRT_KERNEL_DIR"),
        .extra_options = options,
        .entry = &entry,
        .choice = batch->choice,
        .traits = traits_general((SceneTraits){0}),
        .arithmetic_is_exact = kernel_folder != NULL}; // skips the test of arithmetic, which some
                                                       // folders change on purpose
    const FirstRun first = {make_kernels, batch};
    require(program_make(&batch->program, &source, &first, &error), &error);
    file_free(&file);
}

void ray_batch_close(RayBatch *batch)
{
    for (int array = 0; array < FLAT_ARRAYS; array++)
        clReleaseMemObject(batch->arrays[array]);
    for (int task = 0; task < BATCH_TASKS; task++)
        clReleaseKernel(batch->kernels[task]);
    clReleaseMemObject(batch->rays);
    clReleaseMemObject(batch->hits);
    clReleaseMemObject(batch->outward);
    program_free(&batch->program);
    device_close(&batch->device);
    *batch = (RayBatch){0};
}

int ray_batch_setup(void **state)
{
    static RayBatch batch;
    ray_batch_open(&batch, NULL, NULL);
    *state = &batch;
    return 0;
}

int ray_batch_teardown(void **state)
{
    ray_batch_close(*state);
    return 0;
}

void ray_batch_upload(RayBatch *batch, const FlatScene *flat)
{
    FlatArray arrays[FLAT_ARRAYS];
    assert_int_equal(flat->layout, batch->choice.nodes);
    flat_arrays(flat, arrays);
    for (int place = 0; place < FLAT_ARRAYS; place++)
        set_array(batch, place, &arrays[place]);
    batch->frame = (FrameData){.sphere_count = flat->sphere_count,
                               .sphere_entries = flat->sphere_entries,
                               .triangle_count = flat->triangle_count,
                               .sphere_root = flat->sphere_root,
                               .uses_bvh = flat->triangle_count > 0 && flat->node_count > 0};
}

void ray_batch_upload_sphere(RayBatch *batch, const SphereData *sphere)
{
    SphereData data = *sphere;
    ray_batch_upload(batch, &(FlatScene){.layout = batch->choice.nodes,
                                         .spheres = &data,
                                         .sphere_count = 1,
                                         .sphere_entries = 1,
                                         .sphere_root = NOTHING});
}

static void write_buffer(const RayBatch *batch, cl_mem buffer, const void *data, size_t size)
{
    require_success(
        clEnqueueWriteBuffer(batch->device.queue, buffer, CL_TRUE, 0, size, data, 0, NULL, NULL),
        "write a buffer");
}

// Runs a kernel over the first `count` rays in the buffer, and reads their hits.
static void run(const RayBatch *batch, BatchTask task, size_t count, TestHit *hits)
{
    Error error = {0};
    require(launch(batch, task, (cl_uint)count, &error), &error);
    require_success(clEnqueueReadBuffer(batch->device.queue, batch->hits, CL_TRUE, 0,
                                        count * sizeof *hits, hits, 0, NULL, NULL),
                    "read hits");
}

// A ray's index and the properties by which rays are sorted, so that similar rays form beams.
typedef struct {
    uint32_t kind, signs; // signs of the direction
    float origin[3];
    uint32_t index;
} RayOrder;

static RayOrder order_of(const TestRay *ray, uint32_t index)
{
    RayOrder order = {.kind = ray->kind, .index = index};
    memcpy(order.origin, ray->origin, sizeof order.origin);
    for (uint32_t axis = 0; axis < 3; axis++)
        order.signs = 2 * order.signs + (signbit(ray->direction[axis]) != 0);
    return order;
}

static int compare_orders(const void *first, const void *second)
{
    return memcmp(first, second, sizeof(RayOrder));
}

// Returns a sorted array with a RayOrder for each ray. The caller frees the array.
static RayOrder *sorted_orders(Rays rays)
{
    RayOrder *orders = require_memory(rays.count, sizeof *orders);
    for (size_t i = 0; i < rays.count; i++)
        orders[i] = order_of(&rays.data[i], (uint32_t)i);
    qsort(orders, rays.count, sizeof *orders, compare_orders);
    return orders;
}

// Returns the rays from first on, at most as many as a launch takes.
static Rays chunk_of(Rays rays, size_t first)
{
    const size_t left = rays.count - first;
    return (Rays){rays.data + first, left < BATCH_RAYS ? left : BATCH_RAYS};
}

TestHit *ray_batch_trace(const RayBatch *batch, BatchTask task, Rays rays)
{
    TestHit *hits = require_memory(rays.count, sizeof *hits);
    TestRay *ordered = require_memory(BATCH_RAYS, sizeof *ordered);
    TestHit *found = require_memory(BATCH_RAYS, sizeof *found);
    for (size_t first = 0; first < rays.count; first += BATCH_RAYS) {
        const Rays chunk = chunk_of(rays, first);
        RayOrder *orders = sorted_orders(chunk);
        for (size_t i = 0; i < chunk.count; i++)
            ordered[i] = chunk.data[orders[i].index];
        write_buffer(batch, batch->rays, ordered, chunk.count * sizeof *ordered);
        run(batch, task, chunk.count, found);
        for (size_t i = 0; i < chunk.count; i++)
            hits[first + orders[i].index] = found[i];
        free(orders);
    }
    free(ordered);
    free(found);
    return hits;
}

TestHit *ray_batch_leave(const RayBatch *batch, Rays rays, const float (*outward)[3])
{
    TestHit *hits = require_memory(rays.count, sizeof *hits);
    for (size_t first = 0; first < rays.count; first += BATCH_RAYS) {
        const Rays chunk = chunk_of(rays, first);
        write_buffer(batch, batch->rays, chunk.data, chunk.count * sizeof *chunk.data);
        write_buffer(batch, batch->outward, outward + first, chunk.count * sizeof *outward);
        run(batch, BATCH_LEAVE, chunk.count, hits + first);
    }
    return hits;
}
