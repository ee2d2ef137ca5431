// SPDX-License-Identifier: MIT
// Makes each kernel of a device once. Kernels share a program if they have the same source,
// options, choice and traits. A kernel depends on the traits of a scene, but not on the scene's
// data.
#pragma once

#include "device/launch.h"
#include "device/program.h"

typedef struct {
    const Device *device;
    const KernelEntry *entry;
    KernelChoice choice;
    SceneTraits traits;
    uint32_t group[2]; // as in KernelSpec
    LaunchShape launch;
    Program *program;
    cl_kernel handle;
    double seconds;    // time spent on making the kernel
    bool was_compiled; // the cache already had the program
} Kernel;

typedef struct {
    ProgramSource source; // device, cache, kernel folder and extra options of all kernels
    ARRAY(Program *) programs;
    ARRAY(Kernel *) kernels;
} KernelSet;

// If an element of `group` is 0, the device determines it (Kernel::launch).
typedef struct {
    const KernelEntry *entry;
    KernelChoice choice;
    SceneTraits traits;
    uint32_t group[2];
} KernelSpec;

// Returns the kernel for `spec`, or NULL on failure. The kernel belongs to the set.
const Kernel *kernel_set_get(KernelSet *set, const KernelSpec *spec, Error *error);

// Returns whether the set has the kernel for `spec`, or the cache has the kernel's program.
bool kernel_set_has(const KernelSet *set, const KernelSpec *spec);

#define KERNEL_ARGUMENTS 6

typedef struct {
    cl_command_queue queue;
    const FrameData *frame;
    const cl_mem *scene;                     // FLAT_ARRAYS buffers
    const void *arguments[KERNEL_ARGUMENTS]; // pointers to cl_mem or cl_uint (entry->arguments)
    size_t items[2];                         // work-items; kernel_run rounds up to whole groups
    cl_event *done;                          // NULL if not needed
} KernelRun;

// Sets the kernel's arguments and enqueues the kernel. The error message names the kernel.
bool kernel_run(const Kernel *kernel, const KernelRun *run, Error *error);

// Saves new programs to the cache. Returns false if a program could not be saved.
bool kernel_set_save(KernelSet *set);

// Saves new programs, and releases all programs and kernels.
void kernel_set_clear(KernelSet *set);
