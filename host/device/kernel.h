// SPDX-License-Identifier: MIT
// The kernels of a device, each made once. Kernels share a program if their source and their
// options, choice and traits are the same. A kernel needs the traits of a scene, but not its data.
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

// A kernel to make. If a member of group is 0, the device determines it (Kernel::launch).
typedef struct {
    const KernelEntry *entry;
    KernelChoice choice;
    SceneTraits traits;
    uint32_t group[2];
} KernelSpec;

// Returns the kernel for spec, or NULL. The kernel belongs to the set.
const Kernel *kernel_set_get(KernelSet *set, const KernelSpec *spec, Error *error);

// Returns whether the set has the kernel for spec, or the cache has its program.
bool kernel_set_has(const KernelSet *set, const KernelSpec *spec);

#define KERNEL_ARGUMENTS 6

// A run of a kernel.
typedef struct {
    cl_command_queue queue;
    const FrameData *frame;
    const cl_mem *scene;                     // FLAT_ARRAYS buffers
    const void *arguments[KERNEL_ARGUMENTS]; // a cl_mem or cl_uint for each of entry->arguments
    size_t items[2];                         // work-items, rounded up to whole work-groups
    cl_event *done;                          // NULL if not needed
} KernelRun;

// Sets the kernel's arguments and enqueues it. The error message names the kernel.
bool kernel_run(const Kernel *kernel, const KernelRun *run, Error *error);

// Saves new programs to the cache.
void kernel_set_save(KernelSet *set);

// Returns whether kernel_set_save has nothing to do.
bool kernel_set_is_saved(const KernelSet *set);

// Saves new programs, and releases all programs and kernels.
void kernel_set_clear(KernelSet *set);
