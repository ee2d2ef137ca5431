// SPDX-License-Identifier: MIT
// Builds a program for a device from the kernels' source, SceneTraits and a KernelChoice.
#pragma once

#include "accel/flat.h"
#include "device/cache.h"
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
    const Cache *unsaved; // program_save writes the binary to this cache; NULL for none
    char key[CACHE_KEY_SIZE];
} Program;

typedef struct {
    const char *kernel_folder; // replaces kernel_source by the folder's render.cl; may be NULL
    const char *extra_options; // compiler options after clrt's own; NULL without any
    const char *appended;      // source to compile after the kernels; NULL without any
    KernelChoice choice;
    KernelEntry entry;
} ProgramSource;

const char *program_entry_name(KernelEntry entry);

// Loads the program with this key from the cache. Returns false if the cache has none or if the
// driver rejects it.
bool program_load(Program *program, const Device *device, const ProgramSource *source,
                  const SceneTraits *traits, const Cache *cache);

// Builds the program from source. The error message contains the compiler's log.
bool program_build(Program *program, const Device *device, const ProgramSource *source,
                   const SceneTraits *traits, Error *error);

// Writes the binary of an unsaved program to its cache. PoCL takes 0.4 to 0.8 s to make it, because
// it also compiles the kernels for work-groups of any size.
void program_save(Program *program);

// Saves and releases the program.
void program_free(Program *program);

// Writes the key for the cache: a hash of all inputs except the files in kernel_folder.
void program_key(const Device *device, const ProgramSource *source, const SceneTraits *traits,
                 const Cache *cache, char key[CACHE_KEY_SIZE]);
