// SPDX-License-Identifier: MIT
// On CPUs, a launch is one tile of a picture, or at most CPU_ITEMS work-items for a list of
// samples. A GPU needs more work-items than a tile has, because each compute unit runs thousands at
// once. However, a GPU cannot update its display during a launch, and drivers end launches of
// several seconds. The size of a launch therefore depends on the time of the previous launch.
#include "device/launch.h"

#define PAIR_SIDE      8
#define WIDE_SIDE      2
#define GPU_GROUP      64
#define GPU_GROUP_MOST 256

// CPU_ITEMS is below 65535, because PoCL compiles a second version of a kernel for larger grids.
#define CPU_ITEMS 4096

// Large GPUs run up to 2048 work-items per compute unit at once. If a launch has four times this
// number, all units stay busy almost until its end.
#define UNIT_ITEMS 8192
#define ITEMS_MOST (1U << 20)

// The intended time of a launch. Even if a launch's pixels cost three times as much as the pixels
// of the previous launch, the launch takes less than 0.1 s.
#define LAUNCH_SECONDS 0.03

static uint32_t smaller(uint32_t a, uint32_t b)
{
    return a < b ? a : b;
}

// Stores an almost square group. Its number of work-items is a power of two.
static void fit_group(const LaunchFacts *facts, uint32_t group[2])
{
    uint32_t size = GPU_GROUP;
    while (size < facts->group_multiple && size < GPU_GROUP_MOST)
        size *= 2;
    while (facts->group_limit > 0 && size > facts->group_limit)
        size /= 2;
    group[0] = 1;
    while (group[0] * group[0] < size)
        group[0] *= 2;
    group[1] = size / group[0];
}

LaunchShape launch_shape(const LaunchFacts *facts)
{
    const uint32_t side = facts->is_wide ? WIDE_SIDE : PAIR_SIDE;
    LaunchShape shape = {.group = {side, side}, .items = CPU_ITEMS};
    if (facts->is_cpu)
        return shape;
    fit_group(facts, shape.group);
    shape.items = smaller(facts->compute_units, ITEMS_MOST / UNIT_ITEMS) * UNIT_ITEMS;
    shape.items = shape.items > 0 ? shape.items : UNIT_ITEMS;
    shape.is_paced = true;
    return shape;
}

uint32_t launch_first_items(const LaunchShape *shape, double samples)
{
    const double items = shape->items / (4 * samples);
    return items > 1 ? (uint32_t)items : 1;
}

uint32_t launch_next_items(const LaunchShape *shape, uint32_t items, uint32_t done, double seconds)
{
    const uint32_t most = items < shape->items / 2 ? 2 * items : shape->items;
    if (seconds * most < LAUNCH_SECONDS * done)
        return most;
    const double fitting = LAUNCH_SECONDS / seconds * done;
    return fitting > 1 ? (uint32_t)fitting : 1;
}
