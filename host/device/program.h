// SPDX-License-Identifier: MIT
// Embedded kernel source, SceneTraits and KernelChoice -> a built program on a device.
#pragma once

#include "accel/traits.h"
#include "device/device.h"
#include "device/kernel_choice.h"

// All kernel files in the order of their includes, joined at build time.
extern const char kernel_source[];
extern const size_t kernel_source_size;

// Which of the kernels is wanted; the first is in every program.
typedef enum {
    KERNEL_TILE,    // render_tile
    KERNEL_SAMPLES, // trace_samples
    KERNEL_LADDER   // trace_pixels
} KernelEntry;

typedef struct {
    cl_program handle;
} Program;

typedef struct {
    const char *kernel_folder; // read the sources from there; NULL for the embedded ones
    const char *extra_options; // for the compiler, after clrt's own; NULL for none
    const char *appended;      // source to add behind the kernels, for tests; NULL for none
    KernelChoice choice;
    KernelEntry entry;
} ProgramSource;

const char *program_entry_name(KernelEntry entry);

// The message of a failure holds the compiler's log.  The caller calls it between cache_build_begin
// and cache_build_end, and runs each kernel once there: drivers finish compiling then.
bool program_build(Program *program, const Device *device, const ProgramSource *source,
                   const SceneTraits *traits, Error *error);
void program_free(Program *program);

#define PROGRAM_KEY_SIZE 33

// Names the program that these inputs make, for cache_build_begin.
void program_key(const Device *device, const ProgramSource *source, const SceneTraits *traits,
                 char key[PROGRAM_KEY_SIZE]);
