// SPDX-License-Identifier: MIT
// Kernels that are compiled sooner than those that trace fastest, for small pictures of small
// scenes while packets are not compiled yet: 0.8 s instead of 1.3 s to the first picture.
#pragma once

#include "render/ready_kernel.h"

// What is known of a run before anything is built.
typedef struct {
    double samples; // of all pictures together
    uint64_t triangles;
} QuickKernelRun;

// Whether setup's choice is one of packets that are not compiled and that the run will not miss;
// then *choice is what is to take its place.
bool quick_kernel_choose(const RendererSetup *setup, const QuickKernelRun *run,
                         KernelChoice *choice);
