// SPDX-License-Identifier: MIT
// The library gets normalized coordinates as doubles. Its own normalization then changes nothing,
// because the coordinates' box is already centered and its size is from 1 to 2.
#include "library_tracer.h"

#include "check.h"
#include "image/form.h"

#ifdef WITH_LIBRARY
#include <clrt.h>

static ClrtRenderer *renderer;

static void require_library(bool ok, const ClrtError *error)
{
    if (!ok)
        fail_msg("%s", error->text);
}

// Closing the renderer saves new kernels. Saving them at the end of the process would be too late,
// because LLVM may already have shut down.
TEAR_DOWN(close_renderer)
{
    clrt_renderer_free(renderer);
    return 0;
}

static void open_renderer(void)
{
    ClrtError error = {0};
    const KernelChoice form = form_choice();
    const bool is_exact = form.precision == CLRT_FP64;
    const ClrtKernel single = form.nodes == NODES_WIDE ? CLRT_KERNEL_WIDE : CLRT_KERNEL_PAIR;
    const ClrtSettings settings = {.size = sizeof settings,
                                   .device = getenv("CLRT_DEVICE"),
                                   .precision = is_exact ? CLRT_FP64 : CLRT_FP32,
                                   .kernel =
                                       form.family == FAMILY_PACKET ? CLRT_KERNEL_PACKET : single,
                                   .lanes = form.lanes};
    if (renderer != NULL)
        return;
    // PoCL has already read POCL_CACHE_DIR, which shared_cache set to a folder of this process.
    // Without the variable, the library stores its kernels in $XDG_CACHE_HOME.
    unsetenv("POCL_CACHE_DIR");
    renderer = clrt_renderer_create(&settings, &error);
    require_library(renderer != NULL, &error);
}

void library_tracer_open(LibraryTracer *tracer, const Stage *stage, const RayBatch *batch)
{
    ClrtError error = {0};
    const Triangles *triangles = &stage->triangles;
    *tracer = (LibraryTracer){0};
    if (stage->flat.sphere_count > 0 || batch->is_changed)
        return;
    open_renderer();
    double(*positions)[3] = require_memory(triangles->point_count, sizeof *positions);
    for (size_t i = 0; i < triangles->point_count; i++)
        for (int axis = 0; axis < 3; axis++)
            positions[i][axis] = (double)triangles->points[i][axis];
    const ClrtMesh mesh = {.size = sizeof mesh,
                           .positions = positions[0],
                           .triangles = triangles->corners[0],
                           .vertex_count = triangles->point_count,
                           .triangle_count = triangles->count};
    tracer->scene = clrt_scene_create(&error);
    require_library(tracer->scene != NULL && clrt_scene_add_mesh(tracer->scene, &mesh, &error),
                    &error);
    free(positions);
}

void library_tracer_close(LibraryTracer *tracer)
{
    clrt_scene_free(tracer->scene);
}

TestHit *library_tracer_trace(const LibraryTracer *tracer, Rays rays)
{
    ClrtError error = {0};
    double(*ends)[6] = require_memory(rays.count, sizeof *ends);
    double *distances = require_memory(rays.count, sizeof *distances);
    uint32_t *triangles = require_memory(rays.count, sizeof *triangles);
    TestHit *hits = require_memory(rays.count, sizeof *hits);
    for (size_t i = 0; i < rays.count; i++)
        for (int axis = 0; axis < 3; axis++) {
            ends[i][axis] = (double)rays.data[i].origin[axis];
            ends[i][3 + axis] = (double)rays.data[i].direction[axis];
        }
    const ClrtRays given = {.size = sizeof given,
                            .count = rays.count,
                            .origins = ends[0],
                            .directions = ends[0] + 3,
                            .origin_stride = sizeof *ends,
                            .direction_stride = sizeof *ends};
    const ClrtHits found = {.size = sizeof found, .distances = distances, .triangles = triangles};
    require_library(clrt_trace(renderer, tracer->scene, &given, &found, &error), &error);
    for (size_t i = 0; i < rays.count; i++)
        hits[i] = (TestHit){(float)distances[i], triangles[i]};
    free(ends);
    free(distances);
    free(triangles);
    return hits;
}

#else

void library_tracer_open(LibraryTracer *tracer, const Stage *stage, const RayBatch *batch)
{
    (void)stage, (void)batch;
    *tracer = (LibraryTracer){0};
}

void library_tracer_close(LibraryTracer *tracer)
{
    (void)tracer;
}

TestHit *library_tracer_trace(const LibraryTracer *tracer, Rays rays)
{
    (void)tracer, (void)rays;
    return NULL;
}

#endif
