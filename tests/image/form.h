// SPDX-License-Identifier: MIT
// The environment variable CLRT_TEST_KERNEL selects the form of the kernels that tests run: "pair",
// "wide", "packet", "packet16", "packet8", "packet4" or "fp64". The default is clrt's choice for
// the device in CLRT_DEVICE. All forms but "fp64" draw the same picture.
#pragma once

#include "device/kernel_choice.h"

// All forms: five that draw the same bits, and fp64 last.
#define FORMS      6
#define FORMS_FP32 (FORMS - 1)
extern const KernelChoice form_all[FORMS];

// All forms, except that packets have only the device's own number of lanes. These forms suffice
// for channels and explanations, whose code is the same for every number of lanes. fp64 is last.
#define FORMS_FEW 4
extern const KernelChoice form_few[FORMS_FEW];

// Returns the form. On a GPU, single rays replace packets: NVIDIA's compiler takes minutes for
// packets, and several processes at once run out of memory.
KernelChoice form_on_device(const KernelChoice *form, const Device *device);

// Returns the selected form. Ends the process if CLRT_TEST_KERNEL names no form.
KernelChoice form_choice(void);
