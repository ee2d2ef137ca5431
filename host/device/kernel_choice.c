// SPDX-License-Identifier: MIT
// On most CPUs, packets trace fastest. By default, clrt uses single rays for GPUs, for fp64 and on
// the platforms in slow_with_packets.
#include "device/kernel_choice.h"

#include <assert.h>
#include <stdio.h>
#include <string.h>

void kernel_choice_write_options(const KernelChoice *choice, char options[KERNEL_OPTIONS_SIZE])
{
    const bool wide = choice->nodes == NODES_WIDE, packet = choice->family == FAMILY_PACKET;
    assert((!packet || wide) && (choice->precision == CLRT_FP32 || !wide));
    const int length = snprintf(options, KERNEL_OPTIONS_SIZE,
                                "-DCLRT_WIDE_NODES=%d -DCLRT_PACKET=%d -DCLRT_FP64=%d", wide,
                                packet, choice->precision == CLRT_FP64);
    if (choice->lanes > 0)
        snprintf(options + length, KERNEL_OPTIONS_SIZE - (size_t)length, " -DCLRT_LANES=%u",
                 choice->lanes);
}

bool kernel_choice_is_valid(const ClrtSettings *wanted)
{
    const uint32_t lanes = wanted->lanes;
    const bool has_lanes = lanes == 4 || lanes == 8 || lanes == 16;
    return wanted->kernel >= CLRT_KERNEL_WIDE
               ? wanted->precision == CLRT_FP32 && (lanes == 0 || has_lanes)
               : lanes == 0;
}

// On these CPU platforms, packets compile or trace so slowly that single rays are faster in most
// runs. docs/devices.md has the measurements.
static const char *const slow_with_packets[] = {"Intel(R) OpenCL", "rusticl"};

bool kernel_choice_suits_packets(const Device *device)
{
    for (size_t i = 0; i < sizeof slow_with_packets / sizeof *slow_with_packets; i++)
        if (strcmp(device->facts.platform, slow_with_packets[i]) == 0)
            return false;
    return device->is_cpu;
}

KernelChoice kernel_choice_make(const ClrtSettings *wanted, const Device *device)
{
    ClrtKernel kernel = wanted->kernel;
    if (kernel == CLRT_KERNEL_AUTO && wanted->precision == CLRT_FP32 &&
        kernel_choice_suits_packets(device))
        kernel = CLRT_KERNEL_PACKET;
    return (KernelChoice){.family = kernel == CLRT_KERNEL_PACKET ? FAMILY_PACKET : FAMILY_RAY,
                          .nodes = kernel <= CLRT_KERNEL_PAIR ? NODES_PAIR : NODES_WIDE,
                          .lanes = wanted->lanes,
                          .precision = wanted->precision};
}

bool kernel_choice_check_device(const KernelChoice *choice, const Device *device, Error *error)
{
    return choice->precision == CLRT_FP32 || device->facts.fp64 ||
           error_set(error, "%s has no double arithmetic, which --precision fp64 needs",
                     device->facts.name);
}

const char *kernel_family_name(KernelFamily family)
{
    return family == FAMILY_PACKET ? "packet" : "ray";
}

const char *kernel_nodes_name(NodeLayout nodes)
{
    return nodes == NODES_WIDE ? "wide" : "pair";
}

const char *kernel_precision_name(ClrtPrecision precision)
{
    return precision == CLRT_FP64 ? "fp64" : "fp32";
}
