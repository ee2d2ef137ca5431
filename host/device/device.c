// SPDX-License-Identifier: MIT
// Queries the devices of all platforms of the ICD loader, and opens the chosen device.
#include "device/device.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const struct {
    const char *name;
    cl_device_type type;
} types[] = {{"cpu", CL_DEVICE_TYPE_CPU},
             {"gpu", CL_DEVICE_TYPE_GPU},
             {"accelerator", CL_DEVICE_TYPE_ACCELERATOR},
             {"all", CL_DEVICE_TYPE_ALL}};

#define TYPE_COUNT (sizeof types / sizeof *types)

static bool has_extension(cl_device_id id, const char *name)
{
    char names[8192] = "";
    clGetDeviceInfo(id, CL_DEVICE_EXTENSIONS, sizeof names - 1, names, NULL);
    return strstr(names, name) != NULL;
}

static const char *type_name(cl_device_type type)
{
    for (size_t i = 0; i + 1 < TYPE_COUNT; i++)
        if ((types[i].type & type) != 0)
            return types[i].name;
    return "other";
}

static void describe(Device *device)
{
    cl_device_fp_config config = 0, double_config = 0;
    cl_bool shares_memory = CL_FALSE;
    cl_platform_id platform = NULL;
    ClrtDevice *facts = &device->facts;
    clGetDeviceInfo(device->id, CL_DEVICE_PLATFORM, sizeof platform, &platform, NULL);
    clGetPlatformInfo(platform, CL_PLATFORM_NAME, sizeof facts->platform - 1, facts->platform,
                      NULL);
    clGetPlatformInfo(platform, CL_PLATFORM_VERSION, sizeof device->platform_version - 1,
                      device->platform_version, NULL);
    clGetDeviceInfo(device->id, CL_DEVICE_NAME, sizeof facts->name - 1, facts->name, NULL);
    clGetDeviceInfo(device->id, CL_DRIVER_VERSION, sizeof facts->driver - 1, facts->driver, NULL);
    clGetDeviceInfo(device->id, CL_DEVICE_MAX_MEM_ALLOC_SIZE, sizeof facts->largest_allocation,
                    &facts->largest_allocation, NULL);
    clGetDeviceInfo(device->id, CL_DEVICE_MAX_COMPUTE_UNITS, sizeof facts->compute_units,
                    &facts->compute_units, NULL);
    clGetDeviceInfo(device->id, CL_DEVICE_SINGLE_FP_CONFIG, sizeof config, &config, NULL);
    clGetDeviceInfo(device->id, CL_DEVICE_DOUBLE_FP_CONFIG, sizeof double_config, &double_config,
                    NULL);
    clGetDeviceInfo(device->id, CL_DEVICE_TYPE, sizeof device->type, &device->type, NULL);
    clGetDeviceInfo(device->id, CL_DEVICE_HOST_UNIFIED_MEMORY, sizeof shares_memory, &shares_memory,
                    NULL);
    snprintf(facts->device, sizeof facts->device, "%u:%u", device->platform_number, device->number);
    snprintf(facts->type, sizeof facts->type, "%s", type_name(device->type));
    facts->denormals = (config & CL_FP_DENORM) != 0;
    facts->fma = (config & CL_FP_FMA) != 0;
    facts->correctly_rounded = (config & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) != 0;
    facts->fp64 = double_config != 0;
    device->is_cpu = (device->type & CL_DEVICE_TYPE_CPU) != 0;
    device->shares_memory = shares_memory == CL_TRUE;
    device->limits_registers = has_extension(device->id, "cl_nv_compiler_options");
}

static void add_devices(DeviceList *list, cl_platform_id platform, unsigned number)
{
    cl_device_id ids[DEVICES_MOST];
    cl_uint count = 0;
    if (clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, DEVICES_MOST, ids, &count) != CL_SUCCESS)
        return;
    for (cl_uint i = 0; i < count && i < DEVICES_MOST && list->count < DEVICES_MOST; i++) {
        Device *device = &list->devices[list->count++];
        *device = (Device){.id = ids[i], .platform_number = number, .number = i};
        describe(device);
    }
}

bool device_list(DeviceList *list, Error *error)
{
    cl_platform_id platforms[DEVICES_MOST];
    cl_uint count = 0;
    list->count = 0;
    if (clGetPlatformIDs(DEVICES_MOST, platforms, &count) != CL_SUCCESS)
        count = 0;
    for (cl_uint i = 0; i < count && i < DEVICES_MOST; i++)
        add_devices(list, platforms[i], i);
    return list->count > 0 ||
           error_set(error,
                     "no OpenCL device was found: install pocl-opencl-icd (any CPU) or the OpenCL "
                     "driver of your GPU; PoCL shows none if it cannot use its cache: set "
                     "POCL_CACHE_DIR to a folder with 16 MB of free space and without noexec; "
                     "clinfo lists the devices");
}

void device_list_text(const DeviceList *list, char text[DEVICE_TEXT_SIZE])
{
    size_t used = 0;
    text[0] = '\0';
    for (unsigned i = 0; i < list->count && used < DEVICE_TEXT_SIZE; i++) {
        const Device *device = &list->devices[i];
        const bool last =
            i + 1 == list->count || list->devices[i + 1].platform_number != device->platform_number;
        char platform[sizeof device->facts.platform + 32] = "";
        if (device->number == 0)
            snprintf(platform, sizeof platform, "Platform #%u: %s\n", device->platform_number,
                     device->facts.platform);
        used +=
            (size_t)snprintf(text + used, DEVICE_TEXT_SIZE - used, "%s %s Device #%u: %s\n",
                             platform, last ? "`--" : "+--", device->number, device->facts.name);
    }
}

static bool matches(const Device *device, const char *spec)
{
    unsigned platform, number;
    int length = 0;
    if (sscanf(spec, "%u:%u%n", &platform, &number, &length) == 2 && spec[length] == '\0')
        return device->platform_number == platform && device->number == number;
    for (size_t i = 0; i < TYPE_COUNT; i++)
        if (strcasecmp(spec, types[i].name) == 0)
            return (types[i].type & device->type) != 0;
    return strcasestr(device->facts.name, spec) != NULL ||
           strcasestr(device->facts.platform, spec) != NULL;
}

static const Device *choose(const DeviceList *list, const char *spec)
{
    const char *wanted = spec == NULL ? "gpu" : spec;
    for (unsigned i = 0; i < list->count; i++)
        if (matches(&list->devices[i], wanted))
            return &list->devices[i];
    return spec == NULL ? &list->devices[0] : NULL;
}

static bool no_match(const DeviceList *list, const char *spec, Error *error)
{
    char text[DEVICE_TEXT_SIZE];
    device_list_text(list, text);
    return error_set(error, "no device matches '%s'; the devices are:\n%s", spec, text);
}

bool device_open(Device *device, const char *spec, Error *error)
{
    DeviceList list;
    *device = (Device){0};
    if (!device_list(&list, error))
        return false;
    const Device *chosen = choose(&list, spec);
    if (chosen == NULL)
        return no_match(&list, spec, error);
    *device = *chosen;
    cl_int status;
    device->context = clCreateContext(NULL, 1, &device->id, NULL, NULL, &status);
    if (!cl_succeeded(status, "create an OpenCL context", error))
        return false;
    device->queue = clCreateCommandQueue(device->context, device->id, 0, &status);
    if (cl_succeeded(status, "create an OpenCL queue", error))
        device->pool = host_pool_make(device->context, device->queue, error);
    if (device->pool != NULL)
        return true;
    device_close(device);
    return false;
}

void device_close(Device *device)
{
    host_pool_free(device->pool);
    if (device->queue != NULL)
        clReleaseCommandQueue(device->queue);
    if (device->context != NULL)
        clReleaseContext(device->context);
    *device = (Device){0};
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
