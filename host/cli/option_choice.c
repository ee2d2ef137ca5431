// SPDX-License-Identifier: MIT
// Each function names its words in the order of what they stand for.
#include "cli/option_choice.h"

#include "cli/option_value.h"

bool read_kernel(Options *options, const char *value, Error *error)
{
    static const char *const names[] = {"auto", "ray", "packet"};
    const int choice = read_choice(value, "kernel", names, 3, error);
    options->kernel.family_given = choice > 0;
    options->kernel.choice.family = choice == 2 ? FAMILY_PACKET : FAMILY_RAY;
    return choice >= 0;
}

bool read_nodes(Options *options, const char *value, Error *error)
{
    static const char *const names[] = {"auto", "pair", "wide"};
    const int choice = read_choice(value, "nodes", names, 3, error);
    options->kernel.nodes_given = choice > 0;
    options->kernel.choice.nodes = choice == 2 ? NODES_WIDE : NODES_PAIR;
    return choice >= 0;
}

bool read_lanes(Options *options, const char *value, Error *error)
{
    static const char *const names[] = {"auto", "4", "8", "16"};
    static const uint32_t lanes[] = {0, 4, 8, 16};
    const int choice = read_choice(value, "lanes", names, 4, error);
    options->kernel.choice.lanes = choice > 0 ? lanes[choice] : 0;
    return choice >= 0;
}

bool read_precision(Options *options, const char *value, Error *error)
{
    static const char *const names[] = {"fp32", "fp64"};
    const int choice = read_choice(value, "precision", names, 2, error);
    options->kernel.choice.precision = choice == 1 ? PRECISION_FP64 : PRECISION_FP32;
    return choice >= 0;
}

bool read_bvh(Options *options, const char *value, Error *error)
{
    static const char *const names[] = {"sah", "midpoint"};
    const int choice = read_choice(value, "bvh", names, 2, error);
    options->builder = choice == 1 ? BVH_MIDPOINT : BVH_SAH;
    return choice >= 0;
}

bool read_specialize(Options *options, const char *value, Error *error)
{
    static const char *const names[] = {"auto", "always", "never"};
    const int choice = read_choice(value, "specialize", names, 3, error);
    options->specialization = choice == 1   ? SPECIALIZE_ALWAYS
                              : choice == 2 ? SPECIALIZE_NEVER
                                            : SPECIALIZE_AUTO;
    return choice >= 0;
}

bool read_encode(Options *options, const char *value, Error *error)
{
    static const char *const names[] = {"raw", "srgb"};
    const int choice = read_choice(value, "encode", names, 2, error);
    options->encoding = choice == 1 ? ENCODE_SRGB : ENCODE_RAW;
    return choice >= 0;
}

bool read_bad_geometry(Options *options, const char *value, Error *error)
{
    static const char *const names[] = {"drop", "fail"};
    const int choice = read_choice(value, "bad-geometry", names, 2, error);
    options->bad_geometry = choice == 1 ? BAD_GEOMETRY_FAIL : BAD_GEOMETRY_DROP;
    return choice >= 0;
}

bool read_list_devices(Options *options, const char *value, Error *error)
{
    static const char *const names[] = {"text", "json"};
    const int choice = value == NULL ? 0 : read_choice(value, "list-devices", names, 2, error);
    options->action = ACTION_LIST_DEVICES;
    options->lists_json = choice == 1;
    return choice >= 0;
}
