// SPDX-License-Identifier: MIT
// Opens the device and makes the kernel on a thread of its own, while the scene is read and its
// tree is built.
#pragma once

#include "cli/options/options.h"

#include <pthread.h>

// Once the device is open, setup and what follows it belong to the caller, but for setup.ready.
typedef struct {
    RendererSetup setup;
    Device device;
    double device_seconds;
    uint32_t group[2]; // size of work-groups
    bool is_quick;     // the kernels are those that are compiled sooner
    // The thread's own:
    const Options *options;
    ReadyKernel ready;
    Error error;
    pthread_t thread;
    pthread_mutex_t mutex; // over the four below
    pthread_cond_t changed;
    bool is_done, is_open;      // with the device; and it went well
    bool is_decided, is_wanted; // the kernel
    bool is_running, exists;    // the caller's: the thread; the mutex and the condition
} AsyncDevice;

// Starts; setup holds the cache and where the kernels' source is.
void async_device_begin(AsyncDevice *async, const Options *options, RendererSetup setup);

// Says whether a kernel is wanted ahead.  Until then one is made that is compiled already, but no
// other.  The first word counts.
void async_device_decide(AsyncDevice *async, bool wanted);

// Waits for the device; false with the reason where there is none.
bool async_device_wait_device(AsyncDevice *async, Error *error);

// Takes kernels that are compiled sooner where that pays and the options leave them open.  Once the
// device is open and before a kernel is wanted: one that is made ahead nevertheless is compiled,
// and then this changes nothing.
void async_device_choose(AsyncDevice *async, const RenderSettings *settings, uint64_t triangles);

// Waits for the kernel, which stands in setup.ready then.  Where it could not be made it is empty,
// and the renderer will find the reason.
void async_device_wait_kernel(AsyncDevice *async);

// Frees what is left.
void async_device_free(AsyncDevice *async);
