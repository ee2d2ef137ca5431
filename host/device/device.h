// SPDX-License-Identifier: MIT
// Chooses an OpenCL device, and opens a context and a queue on it.
#pragma once

#include "device/host_memory.h"
#include "library/clrt.h"

#include <pthread.h>
#include <stdint.h>

typedef struct {
    ClrtDevice facts; // facts.size is not used
    cl_device_id id;
    cl_context context;
    cl_command_queue queue;
    HostPool *pool;                   // for HostMemory
    unsigned platform_number, number; // PLATFORM:DEVICE
    cl_device_type type;
    char platform_version[256]; // with PoCL, also the version of LLVM
    bool is_cpu;
    bool shares_memory;    // reads the host's arrays in place
    bool limits_registers; // its compiler accepts -cl-nv-maxrregcount
} Device;

// Opens the first device that matches `spec`. Valid forms are "PLATFORM:DEVICE" with numbers from
// device_list, a type (cpu, gpu, accelerator, all), and a part of a device's or platform's name.
// The case of letters does not matter. NULL selects the first GPU or, without a GPU, the first
// device. If nothing matches, the error message lists the devices.
bool device_open(Device *device, const char *spec, Error *error);
void device_close(Device *device);

#define DEVICES_MOST 64

// The available devices, without context and queue.
typedef struct {
    Device devices[DEVICES_MOST];
    unsigned count;
} DeviceList;

// Lists the first DEVICES_MOST devices. Fails if there are none.
bool device_list(DeviceList *list, Error *error);

#define DEVICE_TEXT_SIZE 4096

// Writes as many devices as fit into `text`, in the format of `clinfo -l`.
void device_list_text(const DeviceList *list, char text[DEVICE_TEXT_SIZE]);

// Starts a thread that may build programs. Its stack is larger than usual, because OpenCL compilers
// recurse deeply. Returns false if the system cannot start a thread.
bool device_thread_start(pthread_t *thread, void *(*work)(void *context), void *context);
