// SPDX-License-Identifier: MIT
// Traces rays with clrt_trace, in the form of the kernels that the test uses (image/form.h).
#pragma once

#include "ray_batch.h"
#include "stage.h"

typedef struct {
    struct ClrtScene *scene; // NULL if the library does not trace the stage
} LibraryTracer;

// Gives the library the stage's triangles. Does nothing if the stage has spheres or
// batch->is_changed is set.
void library_tracer_open(LibraryTracer *tracer, const Stage *stage, const RayBatch *batch);
void library_tracer_close(LibraryTracer *tracer);

// Returns the rays' hits. The caller frees them. Ignores TestRay::own.
TestHit *library_tracer_trace(const LibraryTracer *tracer, Rays rays);
