// SPDX-License-Identifier: MIT
// Arrays on the host -> buffers on a device, and back.
#pragma once

#include "accel/flat.h"
#include "device/device.h"

// Makes *buffer from an array. The array's data must outlive the buffer, because some devices read
// the data in place. Kernels do not read the buffer of an empty array. Fails if the array exceeds
// the device's largest allocation.
bool buffer_upload(const Device *device, const FlatArray *array, cl_mem *buffer, Error *error);

// Makes an uninitialized buffer of `size` bytes. `data` is NULL, or the only array from and to
// which the host copies the buffer. If the device shares the host's memory, the array is then the
// buffer, so nothing is copied. The array must outlive the buffer.
bool buffer_make(const Device *device, void *data, size_t size, cl_mem *buffer, Error *error);

// Waits for the device's queue and copies `size` bytes of a buffer to `target`.
bool buffer_read(const Device *device, cl_mem buffer, void *target, size_t size, Error *error);

// Releases the buffer, unless it is NULL, and sets it to NULL.
void buffer_release(cl_mem *buffer);
