// SPDX-License-Identifier: MIT
// Builds a program from a binary in the cache or, without a usable binary, from source.
// docs/devices.md lists the times of both.
//
// Invariant: the key of a cached program contains every input of the compiler that changes its
// kernels. These are the source, the options, the device, the versions of its driver and platform,
// and PoCL's environment variables. Equal keys therefore stand for equivalent programs.
#include "device/program.h"

#include "base/array.h"
#include "device/arithmetic.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#define OPTIONS_SIZE 2048

static const char *text_or_nothing(const char *text)
{
    return text != NULL ? text : "";
}

static const KernelEntry *entry_of(const ProgramSource *source)
{
    static const KernelEntry none = {0};
    return source->entry != NULL ? source->entry : &none;
}

// Returns whether the program gets the options for GPUs. fp64 programs do not get them, because a
// ray's state does not fit into registers in fp64. In fp64, NVIDIA's compiler (580.159) also takes
// three times as long for the certainty kernel with these options, and the compiled kernel decides
// some pixels wrongly.
static bool is_for_gpu(const ProgramSource *source)
{
    return !source->device->is_cpu && source->choice.precision == CLRT_FP32;
}

// With at most 96 registers instead of 168, an H200 runs almost twice as many work-items at once.
// More work-items can then run while others wait for memory. Pictures take 8 to 23 % less time
// (docs/devices.md).
static const char *register_limit(const ProgramSource *source)
{
    const bool is_limited = source->device->limits_registers && is_for_gpu(source);
    return is_limited ? "-cl-nv-maxrregcount=96" : "";
}

static bool write_options(char options[OPTIONS_SIZE], const ProgramSource *source)
{
    char switches[TRAITS_OPTIONS_SIZE];
    char choices[KERNEL_OPTIONS_SIZE];
    traits_write_options(&source->traits, switches);
    kernel_choice_write_options(&source->choice, choices);
    const bool is_correct = source->device->facts.correctly_rounded;
    const int length = snprintf(options, OPTIONS_SIZE, "-cl-std=CL1.2 %s %s %s %s %s %s %s",
                                switches, choices, is_for_gpu(source) ? "-DCLRT_GPU=1" : "",
                                register_limit(source), text_or_nothing(entry_of(source)->options),
                                is_correct ? "-cl-fp32-correctly-rounded-divide-sqrt" : "",
                                text_or_nothing(source->extra_options));
    return length > 0 && length < OPTIONS_SIZE;
}

// Includes are relative to the including file, so the kernel files find each other. An absolute
// path avoids the -I option, whose quoting differs between drivers.
static bool write_include(char include[PATH_MAX + 32], const char *folder, Error *error)
{
    char path[PATH_MAX];
    if (realpath(folder, path) == NULL)
        return error_set(error, "the kernel folder %s cannot be read: %s", folder, strerror(errno));
    snprintf(include, PATH_MAX + 32, "#include \"%s/render.cl\"\n", path);
    return true;
}

static bool create_program(Program *program, const ProgramSource *source, Error *error)
{
    char include[PATH_MAX + 32];
    const bool embedded = source->kernel_folder == NULL;
    if (!embedded && !write_include(include, source->kernel_folder, error))
        return false;
    const char *texts[3] = {embedded ? kernel_source : include,
                            text_or_nothing(entry_of(source)->source),
                            source->arithmetic_is_exact ? "" : arithmetic_source};
    cl_int status;
    program->handle = clCreateProgramWithSource(source->device->context, 3, texts, NULL, &status);
    return cl_succeeded(status, "create the kernel program", error);
}

static void report_build_log(const Program *program, const Device *device, cl_int status,
                             const char *options, Error *error)
{
    size_t size = 0;
    clGetProgramBuildInfo(program->handle, device->id, CL_PROGRAM_BUILD_LOG, 0, NULL, &size);
    char *log = calloc(size + 1, 1);
    if (log != NULL)
        clGetProgramBuildInfo(program->handle, device->id, CL_PROGRAM_BUILD_LOG, size, log, NULL);
    error_set(error, "the kernels do not build with '%s' on %s: %s\n%s", options,
              device->facts.name, cl_error_name(status), log != NULL ? log : "");
    free(log);
}

bool program_build(Program *program, const ProgramSource *source, Error *error)
{
    char options[OPTIONS_SIZE];
    const Device *device = source->device;
    *program = (Program){0};
    if (!write_options(options, source))
        return error_set(error, "the options for the kernels' compiler are too long");
    if (!create_program(program, source, error))
        return false;
    const cl_int status = clBuildProgram(program->handle, 1, &device->id, options, NULL, NULL);
    if (status != CL_SUCCESS)
        report_build_log(program, device, status, options, error);
    else if (source->arithmetic_is_exact ||
             arithmetic_is_exact(device, program->handle, options, error))
        return true;
    program_free(program);
    return false;
}

// Loads the program from the cache. Returns false if the cache has no binary or the driver rejects
// it. Programs from a kernel_folder are never loaded, because their key does not contain the files
// of the folder.
static bool load(Program *program, const ProgramSource *source)
{
    char options[OPTIONS_SIZE];
    CachedBinary binary;
    cl_int status, accepted = CL_SUCCESS;
    const Device *device = source->device;
    *program = (Program){0};
    program_key(source, program->key);
    if (source->kernel_folder != NULL || !write_options(options, source) ||
        !cache_read(source->cache, program->key, &binary))
        return false;
    program->handle = clCreateProgramWithBinary(device->context, 1, &device->id, &binary.size,
                                                &binary.bytes, &accepted, &status);
    file_free(&binary.file);
    if (status == CL_SUCCESS && accepted == CL_SUCCESS &&
        clBuildProgram(program->handle, 1, &device->id, options, NULL, NULL) == CL_SUCCESS)
        return true;
    program_free(program);
    return false;
}

static bool build_and_run(Program *program, const ProgramSource *source, const FirstRun *first,
                          Error *error)
{
    const Cache *cache = source->cache;
    if (cache->announce != NULL)
        cache->announce(true);
    const bool ok = program_build(program, source, error) && first->run(first->context, error);
    if (cache->announce != NULL)
        cache->announce(false);
    program_key(source, program->key);
    const bool is_kept = ok && source->kernel_folder == NULL && cache->folder[0] != '\0';
    program->unsaved = is_kept ? cache : NULL;
    return ok;
}

bool program_make(Program *program, const ProgramSource *source, const FirstRun *first,
                  Error *error)
{
    const int lock = cache_lock(source->cache);
    const bool ok = load(program, source) ? first->run(first->context, error)
                                          : build_and_run(program, source, first, error);
    cache_unlock(lock);
    return ok;
}

bool program_is_compiled(const ProgramSource *source)
{
    char key[CACHE_KEY_SIZE];
    program_key(source, key);
    return source->kernel_folder == NULL && cache_has(source->cache, key);
}

static bool write_binary(const Program *program)
{
    size_t size = 0;
    Error unused = {0};
    clGetProgramInfo(program->handle, CL_PROGRAM_BINARY_SIZES, sizeof size, &size, NULL);
    unsigned char *bytes = size > 0 ? memory_raw(size, 1, &unused) : NULL;
    const bool ok = bytes != NULL &&
                    clGetProgramInfo(program->handle, CL_PROGRAM_BINARIES, sizeof bytes, &bytes,
                                     NULL) == CL_SUCCESS &&
                    cache_write(program->unsaved, program->key, bytes, size);
    free(bytes);
    return ok;
}

bool program_save(Program *program)
{
    CachedBinary others; // another process may have saved the program
    if (program->unsaved == NULL)
        return true;
    const bool ok = cache_read(program->unsaved, program->key, &others) || write_binary(program);
    file_free(&others.file);
    program->unsaved = NULL;
    return ok;
}

void program_free(Program *program)
{
    program_save(program);
    if (program->handle != NULL)
        clReleaseProgram(program->handle);
    *program = (Program){0};
}

void program_key(const ProgramSource *source, char key[CACHE_KEY_SIZE])
{
    const Device *device = source->device;
    char text[OPTIONS_SIZE + sizeof *device + PATH_MAX];
    char options[OPTIONS_SIZE] = "";
    write_options(options, source);
    const char *appended = text_or_nothing(entry_of(source)->source);
    snprintf(text, sizeof text, "%s|%s|%s|%s|%s|%llx", device->facts.name, device->facts.driver,
             device->platform_version, options, text_or_nothing(source->kernel_folder),
             (unsigned long long)source->cache->settings);
    const XXH64_hash_t last = XXH3_64bits(appended, strlen(appended));
    const XXH64_hash_t code = XXH3_64bits_withSeed(kernel_source, kernel_source_size, last);
    const XXH128_hash_t hash = XXH3_128bits_withSeed(text, strlen(text), code);
    snprintf(key, CACHE_KEY_SIZE, "%016llx%016llx", (unsigned long long)hash.high64,
             (unsigned long long)hash.low64);
}
