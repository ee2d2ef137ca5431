// SPDX-License-Identifier: MIT
// Buffers and kernels on a device.
#pragma once

#include "accel/flat.h"
#include "device/device.h"

// Makes *buffer from an array, which must outlive it. An empty array also gives a buffer, which
// kernels do not read. Fails if the device does not offer that size in one allocation.
bool upload_array(const Device *device, const FlatArray *array, cl_mem *buffer, Error *error);

// Makes a buffer without contents.
bool device_buffer(const Device *device, size_t size, cl_mem *buffer, Error *error);

// Waits for the device's queue and copies `size` bytes of a buffer.
bool device_read(const Device *device, cl_mem buffer, void *target, size_t size, Error *error);

// Release an object, if there is one, and set it to NULL.
void device_release(cl_mem *buffer);
void device_release_kernel(cl_kernel *kernel);
