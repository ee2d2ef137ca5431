// SPDX-License-Identifier: MIT
// Facts about a device and a kernel -> the sizes of work-groups and launches. The sizes do not
// change results.
#pragma once

#include <stdbool.h>
#include <stdint.h>

typedef struct {
    bool is_cpu;
    bool is_wide; // the kernel has wide nodes, so a work-item renders a block of pixels
    uint32_t compute_units;
    uint32_t group_limit;    // largest number of work-items in the kernel's groups; 0 if unknown
    uint32_t group_multiple; // group sizes should be multiples of this; 0 if unknown
} LaunchFacts;

typedef struct {
    uint32_t group[2]; // work-items, along x and y
    uint32_t items;    // largest number of work-items and, on GPUs, of pixels in a launch
    bool is_paced;     // launches must be short, and may contain several tiles or part of a tile
} LaunchShape;

LaunchShape launch_shape(const LaunchFacts *facts);

// If launches are paced, returns the number of work-items, at least 1, of a picture's first launch.
// Each item traces `samples` samples.
uint32_t launch_first_items(const LaunchShape *shape, double samples);

// Returns the number of work-items of the next launch, from 1 to shape->items. The previous launch
// was limited to `items` items. It had `done` items, at least 1, and took `seconds`.
uint32_t launch_next_items(const LaunchShape *shape, uint32_t items, uint32_t done, double seconds);
