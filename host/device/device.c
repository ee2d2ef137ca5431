// SPDX-License-Identifier: MIT
// Queries every device of every platform from the ICD loader and chooses one.
#include "device/device.h"

#include "base/processors.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

typedef struct {
    cl_device_id id;
    cl_device_type type;
    unsigned platform, device;
    char platform_name[256], name[256];
} Candidate;

typedef struct {
    Candidate data[DEVICES_MOST];
    unsigned count;
} Candidates;

static void add_devices(Candidates *candidates, cl_platform_id platform, unsigned number)
{
    cl_device_id ids[DEVICES_MOST];
    cl_uint count = 0;
    if (clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, DEVICES_MOST, ids, &count) != CL_SUCCESS)
        return;
    for (cl_uint i = 0; i < count && i < DEVICES_MOST && candidates->count < DEVICES_MOST; i++) {
        Candidate *candidate = &candidates->data[candidates->count++];
        *candidate = (Candidate){.id = ids[i], .platform = number, .device = i};
        clGetPlatformInfo(platform, CL_PLATFORM_NAME, sizeof candidate->platform_name - 1,
                          candidate->platform_name, NULL);
        clGetDeviceInfo(ids[i], CL_DEVICE_NAME, sizeof candidate->name - 1, candidate->name, NULL);
        clGetDeviceInfo(ids[i], CL_DEVICE_TYPE, sizeof candidate->type, &candidate->type, NULL);
    }
}

static bool find_candidates(Candidates *candidates, Error *error)
{
    cl_platform_id platforms[DEVICES_MOST];
    cl_uint count = 0;
    candidates->count = 0;
    if (clGetPlatformIDs(DEVICES_MOST, platforms, &count) != CL_SUCCESS)
        count = 0;
    for (cl_uint i = 0; i < count && i < DEVICES_MOST; i++)
        add_devices(candidates, platforms[i], i);
    if (candidates->count == 0)
        return error_set(error,
                         "no OpenCL device was found: install pocl-opencl-icd (any CPU) or the "
                         "OpenCL driver of your GPU; PoCL shows none if it cannot write its "
                         "cache: set POCL_CACHE_DIR to a folder with 16 MB of free space; clinfo "
                         "lists the devices");
    return true;
}

// Appends prefix and name to text, which stays terminated even if it is full.
static void append(char *text, size_t size, const char *prefix, const char *name)
{
    const size_t used = strlen(text);
    snprintf(text + used, size - used, "%s%s", prefix, name);
}

static void write_list(const Candidates *candidates, char *text, size_t size)
{
    text[0] = '\0';
    for (unsigned i = 0; i < candidates->count; i++) {
        const Candidate *candidate = &candidates->data[i];
        const bool last =
            i + 1 == candidates->count || candidates->data[i + 1].platform != candidate->platform;
        char prefix[64];
        if (candidate->device == 0) {
            snprintf(prefix, sizeof prefix, "Platform #%u: ", candidate->platform);
            append(text, size, prefix, candidate->platform_name);
            append(text, size, "\n", "");
        }
        snprintf(prefix, sizeof prefix, " %s Device #%u: ", last ? "`--" : "+--",
                 candidate->device);
        append(text, size, prefix, candidate->name);
        append(text, size, "\n", "");
    }
}

bool device_list(char *text, size_t size, Error *error)
{
    Candidates candidates;
    if (!find_candidates(&candidates, error))
        return false;
    write_list(&candidates, text, size);
    return true;
}

static const struct {
    const char *name;
    cl_device_type type;
} types[] = {{"cpu", CL_DEVICE_TYPE_CPU},
             {"gpu", CL_DEVICE_TYPE_GPU},
             {"accelerator", CL_DEVICE_TYPE_ACCELERATOR},
             {"all", CL_DEVICE_TYPE_ALL}};

#define TYPE_COUNT (sizeof types / sizeof *types)

static bool matches(const Candidate *candidate, const char *spec)
{
    unsigned platform, device;
    int length = 0;
    if (sscanf(spec, "%u:%u%n", &platform, &device, &length) == 2 && spec[length] == '\0')
        return candidate->platform == platform && candidate->device == device;
    for (size_t i = 0; i < TYPE_COUNT; i++)
        if (strcasecmp(spec, types[i].name) == 0)
            return (types[i].type & candidate->type) != 0;
    return strcasestr(candidate->name, spec) != NULL ||
           strcasestr(candidate->platform_name, spec) != NULL;
}

static const Candidate *choose(const Candidates *candidates, const char *spec)
{
    const char *wanted = spec == NULL ? "gpu" : spec;
    for (unsigned i = 0; i < candidates->count; i++)
        if (matches(&candidates->data[i], wanted))
            return &candidates->data[i];
    return spec == NULL ? &candidates->data[0] : NULL;
}

static void describe(Device *device)
{
    cl_device_fp_config config = 0, double_config = 0;
    cl_device_type type = 0;
    cl_bool shares_memory = CL_FALSE;
    cl_platform_id platform = NULL;
    clGetDeviceInfo(device->id, CL_DEVICE_PLATFORM, sizeof platform, &platform, NULL);
    clGetPlatformInfo(platform, CL_PLATFORM_NAME, sizeof device->platform - 1, device->platform,
                      NULL);
    clGetDeviceInfo(device->id, CL_DEVICE_NAME, sizeof device->name - 1, device->name, NULL);
    clGetDeviceInfo(device->id, CL_DRIVER_VERSION, sizeof device->version - 1, device->version,
                    NULL);
    clGetDeviceInfo(device->id, CL_DEVICE_MAX_MEM_ALLOC_SIZE, sizeof device->largest_allocation,
                    &device->largest_allocation, NULL);
    clGetDeviceInfo(device->id, CL_DEVICE_MAX_COMPUTE_UNITS, sizeof device->compute_units,
                    &device->compute_units, NULL);
    clGetDeviceInfo(device->id, CL_DEVICE_SINGLE_FP_CONFIG, sizeof config, &config, NULL);
    clGetDeviceInfo(device->id, CL_DEVICE_DOUBLE_FP_CONFIG, sizeof double_config, &double_config,
                    NULL);
    clGetDeviceInfo(device->id, CL_DEVICE_TYPE, sizeof type, &type, NULL);
    clGetDeviceInfo(device->id, CL_DEVICE_HOST_UNIFIED_MEMORY, sizeof shares_memory, &shares_memory,
                    NULL);
    device->is_cpu = (type & CL_DEVICE_TYPE_CPU) != 0;
    device->shares_memory = shares_memory == CL_TRUE;
    device->correct_division = (config & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) != 0;
    device->has_fp64 = double_config != 0;
}

static const char *type_name(cl_device_type type)
{
    for (size_t i = 0; i + 1 < TYPE_COUNT; i++)
        if ((types[i].type & type) != 0)
            return types[i].name;
    return "other";
}

unsigned device_entries(DeviceEntry entries[DEVICES_MOST], Error *error)
{
    Candidates candidates;
    if (!find_candidates(&candidates, error))
        return 0;
    for (unsigned i = 0; i < candidates.count; i++) {
        const Candidate *candidate = &candidates.data[i];
        entries[i] = (DeviceEntry){.platform = candidate->platform,
                                   .number = candidate->device,
                                   .type = type_name(candidate->type),
                                   .device = {.id = candidate->id}};
        describe(&entries[i].device);
    }
    return candidates.count;
}

bool device_open(Device *device, const char *spec, Error *error)
{
    Candidates candidates;
    *device = (Device){0};
    if (!find_candidates(&candidates, error))
        return false;
    const Candidate *chosen = choose(&candidates, spec);
    if (chosen == NULL) {
        char list[2048];
        write_list(&candidates, list, sizeof list);
        return error_set(error, "no device matches '%s'; there are:\n%s", spec, list);
    }
    device->id = chosen->id;
    describe(device);
    cl_int status;
    device->context = clCreateContext(NULL, 1, &device->id, NULL, NULL, &status);
    if (!cl_succeeded(status, "create an OpenCL context", error))
        return false;
    device->queue = clCreateCommandQueue(device->context, device->id, 0, &status);
    if (cl_succeeded(status, "create an OpenCL queue", error))
        return true;
    device_close(device);
    return false;
}

void device_close(Device *device)
{
    if (device->queue != NULL)
        clReleaseCommandQueue(device->queue);
    if (device->context != NULL)
        clReleaseContext(device->context);
    *device = (Device){0};
}

uint32_t threads_allowed(uint32_t count)
{
    return count > 0 ? count : processors_usable();
}

bool device_thread_start(pthread_t *thread, void *(*work)(void *context), void *context)
{
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, (size_t)16 << 20);
    const bool ok = pthread_create(thread, &attributes, work, context) == 0;
    pthread_attr_destroy(&attributes);
    return ok;
}
