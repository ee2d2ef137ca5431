// SPDX-License-Identifier: MIT
// Opens the device and makes the kernel on a background thread, while the caller reads the scene
// and builds its tree.
#pragma once

#include "cli/options/options.h"

#include <pthread.h>

// Once the device is open, the caller may use the members up to is_quick, except setup.ready.
typedef struct {
    RendererSetup setup;
    Device device;
    double device_seconds;
    uint32_t group[2]; // the sides of work-groups
    bool is_quick;     // async_device_choose has selected kernels that compile faster
    // Internal members:
    const Options *options;
    ReadyKernel ready;
    Error error;
    pthread_t thread;
    pthread_mutex_t mutex; // guards is_done, is_open, is_decided and is_wanted
    pthread_cond_t changed;
    bool is_done, is_open;      // opening the device has finished; it succeeded
    bool is_decided, is_wanted; // the caller has decided about the kernel; the decision
    bool is_running, exists;    // the thread runs; the mutex and the condition exist
} AsyncDevice;

// Starts the thread. The caller must set the cache and the kernels' source in setup.
void async_device_begin(AsyncDevice *async, const Options *options, RendererSetup setup);

// Decides whether the thread makes the kernel. Before the decision, the thread makes it only if the
// cache holds it. Only the first call has an effect.
void async_device_decide(AsyncDevice *async, bool wanted);

// Waits for the device. Returns false with the reason if the device cannot be opened.
bool async_device_wait_device(AsyncDevice *async, Error *error);

// Selects faster-compiling kernels if they save time and the options allow them. Call it after
// async_device_wait_device and before async_device_decide(async, true). It has no effect if the
// cache holds the kernels chosen first.
void async_device_choose(AsyncDevice *async, const RenderSettings *settings, uint64_t triangles);

// Waits until setup.ready holds the kernel. If making the kernel failed, setup.ready is empty, and
// the renderer will report the reason.
void async_device_wait_kernel(AsyncDevice *async);

// Waits for the thread, closes the device and frees all resources.
void async_device_free(AsyncDevice *async);
