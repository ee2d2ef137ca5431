// SPDX-License-Identifier: MIT
// Chooses kernels from the user's request and the device, and writes the choice as switches for the
// compiler (kernels/config.h). All choices with the same precision render the same picture.
#pragma once

#include "accel/traits.h"
#include "device/device.h"
#include "library/clrt.h"

typedef enum {
    FAMILY_RAY,   // rays search the tree one by one
    FAMILY_PACKET // packets of rays search the tree together
} KernelFamily;

// Packets require wide nodes. fp64 traces the same floats of the scene, and requires single rays
// and pair nodes.
typedef struct {
    KernelFamily family;
    NodeLayout nodes;
    uint32_t lanes; // vector width: 4, 8 or 16; 0: the kernels choose it (kernels/lanes.cl)
    ClrtPrecision precision;
} KernelChoice;

// Returns whether the members kernel, lanes and precision fit together. Kernels with wide nodes
// allow 0, 4, 8 or 16 lanes, but not fp64. Other kernels require 0 lanes.
bool kernel_choice_is_valid(const ClrtSettings *wanted);

// Returns the wanted kernels. CLRT_KERNEL_AUTO selects packets for fp32 if
// kernel_choice_suits_packets, and otherwise single rays and pair nodes.
KernelChoice kernel_choice_make(const ClrtSettings *wanted, const Device *device);

// Returns whether packets finish most pictures sooner than single rays, including compilation.
bool kernel_choice_suits_packets(const Device *device);

// Returns false if the device cannot run the chosen kernels.
bool kernel_choice_check_device(const KernelChoice *choice, const Device *device, Error *error);

#define KERNEL_OPTIONS_SIZE 80

// Writes the compiler options that set the switches, as a zero-terminated string.
void kernel_choice_write_options(const KernelChoice *choice, char options[KERNEL_OPTIONS_SIZE]);

const char *kernel_family_name(KernelFamily family);
const char *kernel_nodes_name(NodeLayout nodes);
const char *kernel_precision_name(ClrtPrecision precision);
