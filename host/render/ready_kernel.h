// SPDX-License-Identifier: MIT
// A program on a device -> a kernel that is ready to draw. The kernel has run once without pixels,
// because some drivers finish compiling in the first run. Making a general kernel needs no scene,
// so another thread can read the scene meanwhile.
#pragma once

#include "device/program.h"

typedef struct {
    Program program;
    cl_kernel handle;                   // NULL if the ReadyKernel is empty
    uint32_t group_width, group_height; // work-group size of the first run
    double seconds;                     // time spent on making the kernel
    bool was_compiled;                  // by an earlier process, according to the cache
} ReadyKernel;

// The inputs of a Renderer. The device must outlive the Renderer.
typedef struct {
    const Device *device;
    const Cache *cache;
    ProgramSource source;
    ReadyKernel *ready; // may be NULL; the renderer takes this kernel if it fits
} RendererSetup;

// Runs the kernels of a new program once, because some drivers finish compiling in the first run.
typedef struct {
    bool (*run)(void *context, Error *error);
    void *context;
} FirstRun;

// Loads the program of setup->source from the cache, or builds it from source, and calls
// first->run. program_free saves a new program. On failure, the caller frees the program.
bool program_make(Program *program, const RendererSetup *setup, const SceneTraits *traits,
                  const FirstRun *first, Error *error);

// Returns whether the cache says that an earlier process compiled the kernel for traits.
bool ready_kernel_is_compiled(const RendererSetup *setup, const SceneTraits *traits);

// Makes the kernel for traits and for work-groups of size group.
bool ready_kernel_make(ReadyKernel *ready, const RendererSetup *setup, const SceneTraits *traits,
                       const uint32_t group[2], Error *error);
void ready_kernel_free(ReadyKernel *ready);

// Returns whether ready is the kernel that ready_kernel_make would make.
bool ready_kernel_is(const ReadyKernel *ready, const RendererSetup *setup,
                     const SceneTraits *traits, const uint32_t group[2]);

// Until packets are compiled, kernels that compile faster render small pictures of small scenes.
// The first picture then takes 0.8 s instead of 1.3 s.

// The work of a run.
typedef struct {
    double samples; // of all pictures
    double seconds; // limit for all pictures; 0 for none
    uint64_t triangles;
} QuickKernelRun;

// Returns whether the run should replace setup's packets with faster-compiling kernels. If so,
// stores their KernelChoice in *choice. Returns false if the packets are already compiled.
bool quick_kernel_choose(const RendererSetup *setup, const QuickKernelRun *run,
                         KernelChoice *choice);
