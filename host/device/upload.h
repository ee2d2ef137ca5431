// SPDX-License-Identifier: MIT
// Makes a kernel-readable buffer from a host array: in place if the device shares memory, else a
// copy.
#pragma once

#include "device/device.h"

// Makes *buffer from `size` bytes at data, which must outlive it. An empty array also gives a
// buffer, which kernels do not read. Fails if the device does not offer that size in one
// allocation.
bool upload_array(const Device *device, const void *data, size_t size, cl_mem *buffer,
                  Error *error);
