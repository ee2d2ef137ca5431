// SPDX-License-Identifier: MIT
// Builds a program for a device from the embedded kernel source, SceneTraits and a KernelChoice.
#pragma once

#include "accel/traits.h"
#include "device/device.h"
#include "device/kernel_choice.h"

// All kernel files in the order of their includes, joined at build time.
extern const char kernel_source[];
extern const size_t kernel_source_size;

// The requested kernel. Every program contains the first one.
typedef enum {
    KERNEL_TILE,    // render_tile
    KERNEL_SAMPLES, // trace_samples
    KERNEL_LADDER   // trace_pixels
} KernelEntry;

typedef struct {
    cl_program handle;
} Program;

typedef struct {
    const char *kernel_folder; // folder to read the sources from; NULL for the embedded ones
    const char *extra_options; // for the compiler, after clrt's own; NULL for none
    const char *appended;      // source to append to the kernels, for tests; NULL for none
    KernelChoice choice;
    KernelEntry entry;
} ProgramSource;

const char *program_entry_name(KernelEntry entry);

// Builds the program; the message of a failure holds the compiler's log. Call it between
// cache_build_begin and cache_build_end, and run each kernel once there, because drivers finish
// compiling then.
bool program_build(Program *program, const Device *device, const ProgramSource *source,
                   const SceneTraits *traits, Error *error);
void program_free(Program *program);

#define PROGRAM_KEY_SIZE 33

// Writes the key of the program that these inputs make, for cache_build_begin.
void program_key(const Device *device, const ProgramSource *source, const SceneTraits *traits,
                 char key[PROGRAM_KEY_SIZE]);
