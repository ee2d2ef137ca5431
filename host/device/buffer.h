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
