// SPDX-License-Identifier: MIT
// Opens the device and makes the kernel on its own thread, while the caller reads the scene and
// builds its tree.
#pragma once

#include "cli/options/options.h"

#include <pthread.h>

// Once the device is open, the caller owns the members up to is_quick, except setup.ready.
typedef struct {
    RendererSetup setup;
    Device device;
    double device_seconds;
    uint32_t group[2]; // of work-groups
    bool is_quick;     // the kernels are the ones that compile faster
    // The thread owns the members below.
    const Options *options;
    ReadyKernel ready;
    Error error;
    pthread_t thread;
    pthread_mutex_t mutex; // guards is_done to is_wanted
    pthread_cond_t changed;
    bool is_done, is_open;      // opening the device: finished, succeeded
    bool is_decided, is_wanted; // on making the kernel: decided, decision
    bool is_running, exists;    // the caller's: the thread; the mutex and the condition
} AsyncDevice;

// Starts the thread.  setup must hold the cache and the source of the kernels.
void async_device_begin(AsyncDevice *async, const Options *options, RendererSetup setup);

// Decides whether the thread makes a kernel.  Until then it makes only a compiled one.  The first
// call counts.
void async_device_decide(AsyncDevice *async, bool wanted);

// Waits for the device.  Returns false with the reason if it cannot be opened.
bool async_device_wait_device(AsyncDevice *async, Error *error);

// Switches to faster-compiling kernels if that pays off and the options allow it.  Must be called
// after the device is open and before async_device_decide wants a kernel.  If the thread has made a
// kernel already, that kernel was compiled, and this call changes nothing.
void async_device_choose(AsyncDevice *async, const RenderSettings *settings, uint64_t triangles);

// Waits until setup.ready holds the kernel.  If making it failed, setup.ready is empty, and the
// renderer will report the reason.
void async_device_wait_kernel(AsyncDevice *async);

// Frees the remaining resources.
void async_device_free(AsyncDevice *async);
