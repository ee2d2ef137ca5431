// SPDX-License-Identifier: MIT
// Builds a program for a device from the kernels' source, SceneTraits and a KernelChoice.
#pragma once

#include "accel/traits.h"
#include "device/cache.h"
#include "device/device.h"
#include "device/kernel_choice.h"

// kernels/render.cl and all files that it includes, joined at build time.
extern const char kernel_source[];
extern const size_t kernel_source_size;

// A kernel function. The file that launches the kernel defines its KernelEntry. A new kernel first
// runs without work: FrameData and all numbers are 0, and each buffer has 64 bytes of 0xff.
typedef struct {
    const char *name;
    const char *source;    // compiled after kernel_source; entries may share it; may be NULL
    const char *options;   // compiler options; may be NULL
    const char *arguments; // after frame and scene: 'b' for each buffer, 'n' for each number
    cl_uint dimensions;    // of the work-items
    uint32_t group;        // work-items of a CPU's work-group; 0: as in Kernel::launch
} KernelEntry;

typedef struct {
    cl_program handle;
    const Cache *unsaved; // program_save writes the binary to this cache; NULL for none
    char key[CACHE_KEY_SIZE];
} Program;

// Everything that a program depends on.
typedef struct {
    const Device *device;
    const Cache *cache;
    const char *kernel_folder; // replaces kernel_source by the folder's render.cl; may be NULL
    const char *extra_options; // compiler options after clrt's own; may be NULL
    const KernelEntry *entry;  // NULL for kernel_source alone
    KernelChoice choice;
    SceneTraits traits;
    bool arithmetic_is_exact; // the device's arithmetic needs no test
} ProgramSource;

// Builds the program from source and, unless arithmetic_is_exact, tests the device's arithmetic. If
// the build fails, the error message contains the compiler's log.
bool program_build(Program *program, const ProgramSource *source, Error *error);

// A function that runs a program's kernels for the first time.
typedef struct {
    bool (*run)(void *context, Error *error);
    void *context;
} FirstRun;

// Loads the program from the cache, or builds it from source, and calls first->run. program_free
// saves a new program. The caller frees the program even after a failure.
bool program_make(Program *program, const ProgramSource *source, const FirstRun *first,
                  Error *error);

// Returns whether the cache has a file for the program.
bool program_is_compiled(const ProgramSource *source);

// Writes the binary of an unsaved program to its cache, and returns false if this fails. In the
// library, PoCL takes 0.4 to 0.8 s to make the binary, because PoCL then also compiles the kernels
// for work-groups of any size. In the executable, it takes 1 ms (cache_private_open).
bool program_save(Program *program);

// Saves and releases the program.
void program_free(Program *program);

// Writes the key for the cache: a hash of all inputs except the files in kernel_folder.
void program_key(const ProgramSource *source, char key[CACHE_KEY_SIZE]);
