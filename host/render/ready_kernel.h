// SPDX-License-Identifier: MIT
// Program on a device -> a kernel that draws at once: built, and run once over nothing, since
// drivers finish compiling at the first run.  It needs no scene, so that it can be made while one
// is read.
#pragma once

#include "device/cache_build.h"
#include "device/program.h"

typedef struct {
    Program program;
    cl_kernel handle; // NULL in an empty value
    char key[PROGRAM_KEY_SIZE];
    uint32_t group_width, group_height; // it was run with
    double seconds;                     // that making it took
    bool was_compiled;                  // by an earlier process, as far as the cache knows
} ReadyKernel;

// What a renderer stands on; the device must outlive it.
typedef struct {
    const Device *device;
    const Cache *cache;
    ProgramSource source;
    ReadyKernel *ready; // made beforehand, for the renderer to take if it is the one; or NULL
} RendererSetup;

// Whether an earlier process compiled the kernel for traits, as far as the cache knows.
bool ready_kernel_is_compiled(const RendererSetup *setup, const SceneTraits *traits);

// Makes the kernel for traits, to be run in work-groups of that size.
bool ready_kernel_make(ReadyKernel *ready, const RendererSetup *setup, const SceneTraits *traits,
                       const uint32_t group[2], Error *error);
void ready_kernel_free(ReadyKernel *ready);

// Whether ready is what ready_kernel_make would make.
bool ready_kernel_is(const ReadyKernel *ready, const RendererSetup *setup,
                     const SceneTraits *traits, const uint32_t group[2]);
