// SPDX-License-Identifier: MIT
// Builds a program for a device from the kernels' source, SceneTraits and a KernelChoice.
#pragma once

#include "accel/flat.h"
#include "device/device.h"
#include "device/kernel_choice.h"

// kernels/render.cl and all files that it includes, joined at build time.
extern const char kernel_source[];
extern const size_t kernel_source_size;

// The kernel to build. Every program also contains render_tile.
typedef enum {
    KERNEL_TILE,    // render_tile
    KERNEL_SAMPLES, // trace_samples
    KERNEL_LADDER   // trace_pixels
} KernelEntry;

typedef struct {
    cl_program handle;
} Program;

typedef struct {
    const char *kernel_folder; // replaces kernel_source by the folder's render.cl; may be NULL
    const char *extra_options; // compiler options after clrt's own; NULL without any
    const char *appended;      // source to compile after the kernels; NULL without any
    KernelChoice choice;
    KernelEntry entry;
} ProgramSource;

const char *program_entry_name(KernelEntry entry);

// Builds the program. The error message contains the compiler's log. The caller builds between
// cache_check_begin and cache_check_end, and also runs each kernel once there, because some drivers
// only then finish compiling.
bool program_build(Program *program, const Device *device, const ProgramSource *source,
                   const SceneTraits *traits, Error *error);
void program_free(Program *program);

#define PROGRAM_KEY_SIZE 33

// Writes the key for cache_check_begin: a hash of all inputs except the files in kernel_folder.
void program_key(const Device *device, const ProgramSource *source, const SceneTraits *traits,
                 char key[PROGRAM_KEY_SIZE]);
