// SPDX-License-Identifier: MIT
// Chooses kernels and converts the choice to compiler switches. These switches and the scene's
// traits (accel/flat.h) specialize a program.
#include "device/kernel_choice.h"

#include <assert.h>
#include <stdio.h>
#include <string.h>

// Sides of work-groups, in work-items. With wide nodes, a work-item renders a block of pixels.
#define PAIR_GROUP 8
#define WIDE_GROUP 2

void kernel_write_options(const KernelChoice *choice, char options[KERNEL_OPTIONS_SIZE])
{
    const bool wide = choice->nodes == NODES_WIDE, packet = choice->family == FAMILY_PACKET;
    assert((!packet || wide) && (choice->precision == PRECISION_FP32 || !wide));
    const int length = snprintf(options, KERNEL_OPTIONS_SIZE,
                                "-DCLRT_WIDE_NODES=%d -DCLRT_PACKET=%d -DCLRT_FP64=%d", wide,
                                packet, choice->precision == PRECISION_FP64);
    if (choice->lanes > 0)
        snprintf(options + length, KERNEL_OPTIONS_SIZE - (size_t)length, " -DCLRT_LANES=%u",
                 choice->lanes);
}

static bool wants_family(const KernelRequest *request, KernelFamily family)
{
    return request->family == 1 + (int)family;
}

static bool wants_nodes(const KernelRequest *request, NodeLayout nodes)
{
    return request->nodes == 1 + (int)nodes;
}

bool kernel_check_request(const KernelRequest *request, Error *error)
{
    const bool is_fp64 = request->precision == PRECISION_FP64;
    const bool wants_packets = wants_family(request, FAMILY_PACKET);
    if (is_fp64 && wants_packets)
        return error_set(error, "--precision fp64 traces rays one by one: leave out --kernel "
                                "packet");
    if (is_fp64 && wants_nodes(request, NODES_WIDE))
        return error_set(error, "--precision fp64 uses binary nodes: leave out --nodes "
                                "wide");
    if (request->lanes > 0 && (is_fp64 || wants_nodes(request, NODES_PAIR)))
        return error_set(error, "%s has no vectors: leave out --lanes",
                         is_fp64 ? "--precision fp64" : "--nodes pair");
    if (wants_packets && wants_nodes(request, NODES_PAIR))
        return error_set(error, "--kernel packet uses wide nodes: leave out --nodes pair");
    return true;
}

// CPU platforms on which packets compile or trace so slowly that single rays are faster in
// most runs. docs/devices.md has the measurements.
static const char *const slow_with_packets[] = {"Intel(R) OpenCL", "rusticl"};

bool kernel_suits_packets(const Device *device)
{
    for (size_t i = 0; i < sizeof slow_with_packets / sizeof *slow_with_packets; i++)
        if (strcmp(device->platform, slow_with_packets[i]) == 0)
            return false;
    return device->is_cpu;
}

KernelChoice kernel_choose(const KernelRequest *request, const Device *device)
{
    const bool suits_packets = kernel_suits_packets(device);
    if (request->precision == PRECISION_FP64)
        return (KernelChoice){FAMILY_RAY, NODES_PAIR, 0, PRECISION_FP64};
    const bool wants_pairs = wants_nodes(request, NODES_PAIR);
    KernelChoice choice = {.family = suits_packets && !wants_pairs ? FAMILY_PACKET : FAMILY_RAY,
                           .nodes = suits_packets ? NODES_WIDE : NODES_PAIR,
                           .lanes = request->lanes > 0 ? 2u << request->lanes : 0};
    if (request->family > 0)
        choice.family = (KernelFamily)(request->family - 1);
    if (request->nodes > 0)
        choice.nodes = (NodeLayout)(request->nodes - 1);
    if (choice.family == FAMILY_PACKET)
        choice.nodes = NODES_WIDE;
    return choice;
}

uint32_t kernel_group_side(const KernelChoice *choice)
{
    return choice->nodes == NODES_WIDE ? WIDE_GROUP : PAIR_GROUP;
}

bool kernel_check_device(const KernelChoice *choice, const Device *device, Error *error)
{
    if (choice->lanes > 0 && choice->nodes == NODES_PAIR)
        return error_set(error, "on %s, --lanes needs --nodes wide or --kernel packet",
                         device->name);
    return choice->precision == PRECISION_FP32 || device->has_fp64 ||
           error_set(error, "%s has no double arithmetic, which --precision fp64 needs",
                     device->name);
}

const char *kernel_family_name(KernelFamily family)
{
    return family == FAMILY_PACKET ? "packet" : "ray";
}

const char *kernel_nodes_name(NodeLayout nodes)
{
    return nodes == NODES_WIDE ? "wide" : "pair";
}

const char *kernel_precision_name(Precision precision)
{
    return precision == PRECISION_FP64 ? "fp64" : "fp32";
}
