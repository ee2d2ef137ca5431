// SPDX-License-Identifier: MIT
// Tests whether a device rounds as IEEE 754 requires.
#pragma once

#include "device/device.h"

// kernels/arithmetic.cl, embedded at build time.
extern const char arithmetic_source[];

// Runs the kernel of arithmetic_source and compares its results with results of the host. The
// program must contain this kernel and be compiled with `options`. Divisions and roots are compared
// only if the device promises to round them correctly. Denormal numbers are compared only if the
// device promises to keep them and the options permit them.
bool arithmetic_is_exact(const Device *device, cl_program program, const char *options,
                         Error *error);
