// SPDX-License-Identifier: MIT
// Which form of the kernels the tests run: CLRT_TEST_KERNEL in the environment names one of "pair",
// "wide", "packet", "packet8", "packet4" and "fp64", of which the last draws another picture.
// Unset, it is the one that the program takes without options on the device that CLRT_DEVICE names.
#pragma once

#include "device/kernel_choice.h"

// All forms: five that draw the same bits, and fp64 last.
#define FORMS      6
#define FORMS_FP32 (FORMS - 1)
extern const KernelChoice form_all[FORMS];

// Ends the process where there is no form of that name.
KernelChoice form_choice(void);

// Work-items along the sides of a work-group, as the program has them.
uint32_t form_group(const KernelChoice *choice);
