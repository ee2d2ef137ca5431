// SPDX-License-Identifier: MIT
// The switches stand beside those of the traits: a program is made of both.
#include "device/kernel_choice.h"

#include <assert.h>
#include <stdio.h>

#define RAY_GROUP    8
#define PACKET_GROUP 2

void kernel_write_options(const KernelChoice *choice, char options[KERNEL_OPTIONS_SIZE])
{
    assert(choice->family == FAMILY_RAY || choice->nodes == NODES_WIDE);
    const int length =
        snprintf(options, KERNEL_OPTIONS_SIZE, "-DCLRT_WIDE_NODES=%d -DCLRT_PACKET=%d",
                 choice->nodes == NODES_WIDE, choice->family == FAMILY_PACKET);
    if (choice->lanes > 0)
        snprintf(options + length, KERNEL_OPTIONS_SIZE - (size_t)length, " -DCLRT_LANES=%u",
                 choice->lanes);
}

bool kernel_check_wish(const KernelWish *wish, Error *error)
{
    if (wish->family_given && wish->choice.family == FAMILY_PACKET && wish->nodes_given &&
        wish->choice.nodes == NODES_PAIR)
        return error_set(error, "--kernel packet walks wide nodes: leave out --nodes pair");
    return true;
}

KernelChoice kernel_choose(const KernelWish *wish, bool is_cpu)
{
    const bool wants_pairs = wish->nodes_given && wish->choice.nodes == NODES_PAIR;
    KernelChoice choice = {.family = is_cpu && !wants_pairs ? FAMILY_PACKET : FAMILY_RAY,
                           .nodes = is_cpu ? NODES_WIDE : NODES_PAIR,
                           .lanes = wish->choice.lanes};
    if (wish->family_given)
        choice.family = wish->choice.family;
    if (wish->nodes_given)
        choice.nodes = wish->choice.nodes;
    if (choice.family == FAMILY_PACKET)
        choice.nodes = NODES_WIDE;
    return choice;
}

uint32_t kernel_group_side(const KernelChoice *choice)
{
    return choice->nodes == NODES_WIDE ? PACKET_GROUP : RAY_GROUP;
}

const char *kernel_family_name(KernelFamily family)
{
    return family == FAMILY_PACKET ? "packet" : "ray";
}

const char *kernel_nodes_name(NodeLayout nodes)
{
    return nodes == NODES_WIDE ? "wide" : "pair";
}
