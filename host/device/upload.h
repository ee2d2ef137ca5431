// SPDX-License-Identifier: MIT
// Host array -> buffer that kernels read: in place where the device shares memory, else a copy.
#pragma once

#include "device/device.h"

// Makes *buffer of the `size` bytes at data, which must outlive it; an empty array gives a buffer
// too, of which kernels read nothing.  Fails where the device does not offer that much at once.
bool upload_array(const Device *device, const void *data, size_t size, cl_mem *buffer,
                  Error *error);
