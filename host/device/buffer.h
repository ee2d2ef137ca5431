// SPDX-License-Identifier: MIT
// Arrays on the host -> buffers on a device, and back.
#pragma once

#include "accel/flat.h"
#include "device/device.h"

// Makes *buffer from an array. The array's data must outlive the buffer, because some devices read
// the data in place. Kernels do not read the buffer of an empty array. Fails if the array exceeds
// the device's largest allocation.
bool upload_array(const Device *device, const FlatArray *array, cl_mem *buffer, Error *error);

// Makes an uninitialized buffer of `size` bytes.
bool device_buffer(const Device *device, size_t size, cl_mem *buffer, Error *error);

// Waits for the device's queue and copies `size` bytes of a buffer to `target`.
bool device_read(const Device *device, cl_mem buffer, void *target, size_t size, Error *error);

// Both functions release the object, unless it is NULL, and set it to NULL.
void device_release(cl_mem *buffer);
void device_release_kernel(cl_kernel *kernel);
