// SPDX-License-Identifier: MIT
// Tests whether a device rounds as IEEE 754 requires.
#pragma once

#include "device/device.h"

// kernels/arithmetic.cl, embedded at build time.
extern const char arithmetic_source[];

// Runs arithmetic_source as a part of a program, which was compiled with these options, and
// compares the results with the host's. Denormal numbers, divisions and roots only count if the
// device promises to keep or round them, and denormal numbers only if the options permit them.
bool arithmetic_is_exact(const Device *device, cl_program program, const char *options,
                         Error *error);
