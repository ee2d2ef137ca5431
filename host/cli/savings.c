// SPDX-License-Identifier: MIT
// The figures of tests/bench/traits.txt; test_savings fails where the two differ.
#include "cli/savings.h"

#include <stdio.h>

static const PartCost costs[SCENE_PARTS][2] = {
    [PART_SPHERES] =
        {[FAMILY_PACKET] = {1.67, 1.54, 1.02, 1.02}, [FAMILY_RAY] = {0.98, 0.86, 1.24, 1.24}},
    [PART_TRIANGLES] =
        {[FAMILY_PACKET] = {1.67, 0.88, 1.03, 1.03}, [FAMILY_RAY] = {0.98, 0.80, 1.00, 1.00}},
    [PART_TREE] =
        {[FAMILY_PACKET] = {1.67, 1.35, 1.00, 1.03}, [FAMILY_RAY] = {0.98, 0.94, 1.01, 1.03}},
    [PART_LIGHTS] =
        {[FAMILY_PACKET] = {1.67, 1.64, 1.10, 1.10}, [FAMILY_RAY] = {0.98, 0.93, 1.44, 1.44}},
    [PART_MIRRORS] =
        {[FAMILY_PACKET] = {1.67, 1.62, 1.00, 1.18}, [FAMILY_RAY] = {0.98, 0.89, 1.07, 1.46}},
    [PART_STATISTICS] =
        {[FAMILY_PACKET] = {1.68, 1.67, 1.14, 2.55}, [FAMILY_RAY] = {0.96, 0.98, 1.15, 1.35}},
};

const char *saving_source(KernelFamily family)
{
    return family == FAMILY_PACKET
               ? "with packets in fp32 on 2 cores of an Intel Xeon (PoCL 3.1)"
               : "with single rays through pairs in fp32 on 2 cores of an Intel Xeon (PoCL 3.1)";
}

PartCost saving_measured(ScenePartKind kind, KernelFamily family)
{
    return costs[kind][family];
}

Saving saving_of(ScenePartKind kind, KernelFamily family)
{
    const PartCost cost = saving_measured(kind, family);
    return (Saving){.compiling = 1 - cost.without / cost.with,
                    .tracing_least = 1 - 1 / cost.least,
                    .tracing_most = 1 - 1 / cost.most};
}

bool saving_is_own(const ScenePart parts[SCENE_PARTS], ScenePartKind kind)
{
    return kind != PART_TREE || parts[PART_TRIANGLES].is_compiled;
}

static void describe_tracing(const Saving *saving, char *text, size_t size)
{
    const double least = 100 * saving->tracing_least, most = 100 * saving->tracing_most;
    if (saving->tracing_least <= SAVING_NOISE)
        snprintf(text, size, "up to %.0f %% of tracing", most);
    else if (least < most)
        snprintf(text, size, "%.0f to %.0f %% of tracing", least, most);
    else
        snprintf(text, size, "%.0f %% of tracing", most);
}

void saving_describe(const ScenePart parts[SCENE_PARTS], ScenePartKind kind, KernelFamily family,
                     char text[SAVING_TEXT])
{
    const Saving saving = saving_of(kind, family);
    const bool compiles_sooner = saving.compiling > SAVING_NOISE;
    const bool traces_sooner = saving.tracing_most > SAVING_NOISE;
    char tracing[40];
    describe_tracing(&saving, tracing, sizeof tracing);
    if (!saving_is_own(parts, kind))
        snprintf(text, SAVING_TEXT, "counted with the triangles");
    else if (compiles_sooner && traces_sooner)
        snprintf(text, SAVING_TEXT, "saves %.0f %% of compiling and %s", 100 * saving.compiling,
                 tracing);
    else if (compiles_sooner)
        snprintf(text, SAVING_TEXT, "saves %.0f %% of compiling; tracing within noise",
                 100 * saving.compiling);
    else if (traces_sooner)
        snprintf(text, SAVING_TEXT, "saves %s; compiling within noise", tracing);
    else
        snprintf(text, SAVING_TEXT, "saves nothing beyond noise");
}
