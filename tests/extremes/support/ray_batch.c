// SPDX-License-Identifier: MIT
// All launches of a form have one size: PoCL compiles a kernel again for each local size and kind
// of grid, and compiling has to happen under the cache's lock, which only ray_batch_open holds.
#include "ray_batch.h"

#include "base/file.h"
#include "check.h"
#include "image/form.h"
#include "ray_order.h"

#include <stdlib.h>

#define BATCH_RAYS 65536

// Lanes of kernels with the default lane count, which the host must know.
#define BATCH_LANES 16

static const char *const kernel_names[BATCH_TASKS] = {"batch_nearest", "batch_blocked",
                                                      "batch_each", "batch_boxes", "batch_leave"};

static void require_success(cl_int status, const char *attempt)
{
    Error error = {0};
    require(cl_succeeded(status, attempt, &error), &error);
}

static cl_mem make_buffer(const RayBatch *batch, const void *data, size_t size)
{
    static const char nothing[64];
    cl_int status;
    const cl_mem buffer = clCreateBuffer(
        batch->device.context, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR,
        size > 0 ? size : sizeof nothing, (void *)(size > 0 ? data : nothing), &status);
    require_success(status, "make a buffer");
    return buffer;
}

static cl_mem make_room(const RayBatch *batch, size_t size)
{
    cl_int status;
    const cl_mem buffer =
        clCreateBuffer(batch->device.context, CL_MEM_READ_WRITE, size, NULL, &status);
    require_success(status, "make a buffer");
    return buffer;
}

// Runs a kernel over the first count rays in the buffer.
static bool launch(const RayBatch *batch, BatchTask task, cl_uint count, Error *error)
{
    const bool is_wide = batch->choice.nodes == NODES_WIDE;
    const size_t grid = is_wide ? BATCH_RAYS / batch->choice.lanes : BATCH_RAYS;
    const size_t group = is_wide ? 4 : 64;
    cl_kernel kernel = batch->kernels[task];
    cl_int status = clSetKernelArg(kernel, 0, sizeof batch->frame, &batch->frame);
    status |= clSetKernelArg(kernel, 1, sizeof(cl_mem), &batch->spheres);
    status |= clSetKernelArg(kernel, 2, sizeof(cl_mem), &batch->nodes);
    status |= clSetKernelArg(kernel, 3, sizeof(cl_mem), &batch->triangles);
    status |= clSetKernelArg(kernel, 4, sizeof(cl_mem), &batch->rays);
    status |= clSetKernelArg(kernel, 5, sizeof count, &count);
    status |= clSetKernelArg(kernel, 6, sizeof(cl_mem), &batch->hits);
    if (task == BATCH_LEAVE) {
        status |= clSetKernelArg(kernel, 7, sizeof(cl_mem), &batch->looks);
        status |= clSetKernelArg(kernel, 8, sizeof(cl_mem), &batch->normals);
        status |= clSetKernelArg(kernel, 9, sizeof(cl_mem), &batch->outward);
    }
    if (!cl_succeeded(status, "set the arguments of a kernel", error))
        return false;
    status =
        clEnqueueNDRangeKernel(batch->device.queue, kernel, 1, NULL, &grid, &group, 0, NULL, NULL);
    return cl_succeeded(status, "run a kernel", error);
}

static void run(const RayBatch *batch, BatchTask task, size_t count)
{
    Error error = {0};
    require(launch(batch, task, (cl_uint)count, &error), &error);
}

static bool make_kernels(RayBatch *batch, Error *error)
{
    for (int task = 0; task < BATCH_TASKS; task++) {
        cl_int status;
        batch->kernels[task] = clCreateKernel(batch->program.handle, kernel_names[task], &status);
        if (!cl_succeeded(status, kernel_names[task], error) ||
            !launch(batch, (BatchTask)task, 0, error))
            return false;
    }
    return cl_succeeded(clFinish(batch->device.queue), "finish the first runs", error);
}

// Ends the test only after the lock is given back: the next test of the process waits for it.
static void build_locked(RayBatch *batch, const ProgramSource *source)
{
    Error error = {0};
    char key[PROGRAM_KEY_SIZE];
    CacheBuild build;
    const SceneTraits traits = traits_general(false);
    program_key(&batch->device, source, &traits, key);
    cache_build_begin(&build, &batch->cache, key);
    const bool ok = program_build(&batch->program, &batch->device, source, &traits, &error) &&
                    make_kernels(batch, &error);
    cache_build_end(&build, ok);
    require(ok, &error);
}

void ray_batch_open(RayBatch *batch, const char *kernel_folder, const char *options)
{
    Error error = {0};
    File file = {0};
    *batch = (RayBatch){.choice = form_choice()};
    if (batch->choice.nodes == NODES_WIDE && batch->choice.lanes == 0)
        batch->choice.lanes = BATCH_LANES;
    cache_open(&batch->cache);
    require(device_open(&batch->device, getenv("CLRT_DEVICE"), &error) &&
                file_read(&file, EXTREMES_FOLDER "/support/ray_batch.cl", &error),
            &error);
    batch->rays = make_room(batch, BATCH_RAYS * sizeof(TestRay));
    batch->hits = make_room(batch, BATCH_RAYS * sizeof(TestHit));
    batch->outward = make_room(batch, BATCH_RAYS * sizeof(float[3]));
    ray_batch_upload(batch, &(FlatScene){.layout = batch->choice.nodes});
    const ProgramSource source = {
        .kernel_folder = kernel_folder != NULL ? kernel_folder : getenv("CLRT_KERNEL_DIR"),
        .extra_options = options,
        .appended = file.bytes,
        .choice = batch->choice};
    build_locked(batch, &source);
    file_free(&file);
}

static void release_scene(RayBatch *batch)
{
    cl_mem *buffers[] = {&batch->spheres, &batch->nodes, &batch->triangles, &batch->looks,
                         &batch->normals};
    for (size_t i = 0; i < sizeof buffers / sizeof *buffers; i++) {
        if (*buffers[i] != NULL)
            clReleaseMemObject(*buffers[i]);
        *buffers[i] = NULL;
    }
}

void ray_batch_close(RayBatch *batch)
{
    release_scene(batch);
    for (int task = 0; task < BATCH_TASKS; task++)
        if (batch->kernels[task] != NULL)
            clReleaseKernel(batch->kernels[task]);
    if (batch->rays != NULL)
        clReleaseMemObject(batch->rays);
    if (batch->hits != NULL)
        clReleaseMemObject(batch->hits);
    if (batch->outward != NULL)
        clReleaseMemObject(batch->outward);
    program_free(&batch->program);
    device_close(&batch->device);
    cache_close(&batch->cache);
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
    assert_int_equal(flat->layout, batch->choice.nodes);
    release_scene(batch);
    batch->spheres = make_buffer(batch, flat->spheres, flat->sphere_count * sizeof(SphereData));
    batch->looks = make_buffer(
        batch, flat->looks, flat->looks == NULL ? 0 : flat->triangle_count * sizeof(TriangleLook));
    batch->normals = make_buffer(batch, flat->normals, flat->normals_count * sizeof(CornerNormals));
    if (flat->layout == NODES_WIDE) {
        batch->nodes = make_buffer(batch, flat->wides, flat->node_count * sizeof(BvhWide));
        batch->triangles =
            make_buffer(batch, flat->blocks, flat->block_count * sizeof(TriangleBlock));
    } else {
        batch->nodes = make_buffer(batch, flat->pairs, flat->node_count * sizeof(BvhPair));
        batch->triangles =
            make_buffer(batch, flat->triangles, flat->triangle_count * sizeof(TriangleData));
    }
    batch->block_count = flat->block_count;
    batch->frame = (FrameData){.sphere_count = flat->sphere_count,
                               .triangle_count = flat->triangle_count,
                               .uses_bvh = flat->node_count > 0};
}

static void write_rays(const RayBatch *batch, const TestRay *rays, size_t count)
{
    require_success(clEnqueueWriteBuffer(batch->device.queue, batch->rays, CL_TRUE, 0,
                                         count * sizeof *rays, rays, 0, NULL, NULL),
                    "write rays");
}

static void read_hits(const RayBatch *batch, TestHit *hits, size_t count)
{
    require_success(clEnqueueReadBuffer(batch->device.queue, batch->hits, CL_TRUE, 0,
                                        count * sizeof *hits, hits, 0, NULL, NULL),
                    "read hits");
}

static size_t chunk_of(size_t first, size_t count)
{
    return count - first < BATCH_RAYS ? count - first : BATCH_RAYS;
}

// Traces the rays in an order that suits packets.
static void trace_ordered(const RayBatch *batch, BatchTask task, const TestRay *rays, size_t count,
                          TestHit *hits)
{
    Error error = {0};
    uint32_t *places = memory_raw(count, sizeof *places, &error);
    TestRay *ordered = memory_raw(count, sizeof *ordered, &error);
    TestHit *found = memory_raw(count, sizeof *found, &error);
    require(places != NULL && ordered != NULL && found != NULL, &error);
    ray_order(rays, count, places);
    for (size_t i = 0; i < count; i++)
        ordered[i] = rays[places[i]];
    write_rays(batch, ordered, count);
    run(batch, task, count);
    read_hits(batch, found, count);
    for (size_t i = 0; i < count; i++)
        hits[places[i]] = found[i];
    free(places);
    free(ordered);
    free(found);
}

void ray_batch_trace(const RayBatch *batch, BatchTask task, const TestRay *rays, size_t count,
                     TestHit *hits)
{
    for (size_t first = 0; first < count; first += BATCH_RAYS)
        trace_ordered(batch, task, rays + first, chunk_of(first, count), hits + first);
}

void ray_batch_leave(const RayBatch *batch, const TestRay *rays, const float (*outward)[3],
                     size_t count, TestHit *hits)
{
    for (size_t first = 0; first < count; first += BATCH_RAYS) {
        const size_t chunk = chunk_of(first, count);
        write_rays(batch, rays + first, chunk);
        require_success(clEnqueueWriteBuffer(batch->device.queue, batch->outward, CL_TRUE, 0,
                                             chunk * sizeof *outward, outward + first, 0, NULL,
                                             NULL),
                        "write directions");
        run(batch, BATCH_LEAVE, chunk);
        read_hits(batch, hits + first, chunk);
    }
}

void ray_batch_each(const RayBatch *batch, const TestRay *ray, TestHit *hits)
{
    const bool is_wide = batch->choice.nodes == NODES_WIDE;
    const uint32_t items = is_wide ? batch->block_count : batch->frame.triangle_count;
    assert_true(batch->frame.triangle_count <= BATCH_RAYS);
    assert_true(!is_wide || items <= BATCH_RAYS / batch->choice.lanes);
    write_rays(batch, ray, 1);
    run(batch, BATCH_EACH, items);
    read_hits(batch, hits, batch->frame.triangle_count);
}

// A wide node with the children of a pair and no others.
static BvhWide widened(const BvhPair *pair)
{
    BvhWide wide = {.child_count = 2};
    for (int axis = 0; axis < 3; axis++)
        for (int child = 0; child < WIDE; child++) {
            wide.planes[axis][0][child] = child < 2 ? pair->planes[axis][0][child] : 1;
            wide.planes[axis][1][child] = child < 2 ? pair->planes[axis][1][child] : -1;
        }
    return wide;
}

static cl_mem make_nodes(const RayBatch *batch, const BvhPair *pairs, size_t count)
{
    Error error = {0};
    if (batch->choice.nodes == NODES_PAIR)
        return make_buffer(batch, pairs, count * sizeof *pairs);
    BvhWide *wides = memory_raw(count, sizeof *wides, &error);
    require(wides != NULL, &error);
    for (size_t i = 0; i < count; i++)
        wides[i] = widened(&pairs[i]);
    const cl_mem buffer = make_buffer(batch, wides, count * sizeof *wides);
    free(wides);
    return buffer;
}

void ray_batch_boxes(RayBatch *batch, const TestRay *rays, const BvhPair *nodes, size_t count,
                     TestHit *hits)
{
    for (size_t first = 0; first < count; first += BATCH_RAYS) {
        const size_t chunk = chunk_of(first, count);
        release_scene(batch);
        batch->spheres = make_buffer(batch, NULL, 0);
        batch->triangles = make_buffer(batch, NULL, 0);
        batch->nodes = make_nodes(batch, nodes + first, chunk);
        write_rays(batch, rays + first, chunk);
        run(batch, BATCH_BOXES, chunk);
        read_hits(batch, hits + first, chunk);
    }
}
