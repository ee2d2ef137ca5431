// SPDX-License-Identifier: MIT
// Arrays on the host -> buffers on a device, and back.
#pragma once

#include "accel/flat.h"
#include "device/device.h"

// Makes *buffer from an array. The array's data must outlive the buffer, because some devices read
// the data in place. Kernels do not read the buffer of an empty array. Fails if the array exceeds
// the device's largest allocation.
bool buffer_upload(const Device *device, const FlatArray *array, cl_mem *buffer, Error *error);

// Makes an uninitialized buffer of `size` bytes.
bool buffer_make(const Device *device, size_t size, cl_mem *buffer, Error *error);

// Waits for the device's queue and copies `size` bytes of a buffer to `target`.
bool buffer_read(const Device *device, cl_mem buffer, void *target, size_t size, Error *error);

// Releases the buffer, unless it is NULL, and sets it to NULL.
void buffer_release(cl_mem *buffer);

// An array that the host and a device use in turn. If the device shares the host's memory, the
// array is the mapped buffer, so nothing is copied. Otherwise, the host has its own array.
typedef struct {
    const Device *device;
    cl_mem buffer; // for kernels; NULL if the array does not exist
    void *data;    // for the host
    size_t size;   // bytes
} SharedArray;

// Makes an uninitialized array, which the host may use. The device must outlive it.
bool shared_array_make(SharedArray *array, const Device *device, size_t size, Error *error);
void shared_array_free(SharedArray *array);

// Passes the array to the device, which can rely on the first `used` bytes. The host must not use
// the array until shared_array_receive.
bool shared_array_send(const SharedArray *array, size_t used, Error *error);

// Waits for the device, and passes the array to the host, which can rely on the first `used` bytes.
// `data` may change. After a failure, the array may not exist any more.
bool shared_array_receive(SharedArray *array, size_t used, Error *error);
