// SPDX-License-Identifier: MIT
// Program on a device -> a kernel ready to draw: built, and run once over an empty tile, because
// drivers finish compiling at the first run.  It needs no scene, so it can be made while one is
// read.
#pragma once

#include "device/cache_build.h"
#include "device/program.h"

typedef struct {
    Program program;
    cl_kernel handle; // NULL in an empty value
    char key[PROGRAM_KEY_SIZE];
    uint32_t group_width, group_height; // of the first run
    double seconds;                     // spent on making it
    bool was_compiled;                  // by an earlier process, according to the cache
} ReadyKernel;

// The inputs of a renderer.  The device must outlive it.
typedef struct {
    const Device *device;
    const Cache *cache;
    ProgramSource source;
    ReadyKernel *ready; // made beforehand; the renderer takes it if it fits.  May be NULL
} RendererSetup;

// Returns whether the cache says that an earlier process compiled the kernel for traits.
bool ready_kernel_is_compiled(const RendererSetup *setup, const SceneTraits *traits);

// Makes the kernel for traits and for work-groups of size group.
bool ready_kernel_make(ReadyKernel *ready, const RendererSetup *setup, const SceneTraits *traits,
                       const uint32_t group[2], Error *error);
void ready_kernel_free(ReadyKernel *ready);

// Returns whether ready is the kernel that ready_kernel_make would make.
bool ready_kernel_is(const ReadyKernel *ready, const RendererSetup *setup,
                     const SceneTraits *traits, const uint32_t group[2]);

// Kernels that compile faster than packets draw small pictures of small scenes while packets are
// not compiled yet.  The first picture then takes 0.8 s instead of 1.3 s.

// The facts known before anything is built.
typedef struct {
    double samples; // of all pictures
    uint64_t triangles;
} QuickKernelRun;

// Returns whether the run should replace setup's packets by faster-compiling kernels, and stores
// these in *choice.  It returns false if the packets are already compiled.
bool quick_kernel_choose(const RendererSetup *setup, const QuickKernelRun *run,
                         KernelChoice *choice);
