// SPDX-License-Identifier: MIT
#include "library/ray_grid.h"

// The most rays in a beam, the most rows in a block, and the limits of the rays in a row.
#define BEAM_RAYS   64
#define BLOCK_ROWS  8
#define LEAST_WIDTH 16
#define MOST_WIDTH  8192

static Vec3 step_after(const ClrtRays *rays, size_t index)
{
    const GivenRay a = given_ray(rays, index), b = given_ray(rays, index + 1);
    return vec3_sub(vec3_add(b.origin, b.direction), vec3_add(a.origin, a.direction));
}

// Returns whether a row ends at the ray. `step` is the vector from the first ray's point at t = 1
// to the second ray's.
static bool ends_row(const ClrtRays *rays, size_t index, Vec3 step)
{
    return vec3_dot(step_after(rays, index), step) < 0;
}

size_t ray_grid_width(const ClrtRays *rays)
{
    if (rays->count < 2 * LEAST_WIDTH)
        return 0;
    size_t width = 1;
    const Vec3 step = step_after(rays, 0);
    while (width < MOST_WIDTH && 2 * width < rays->count && !ends_row(rays, width - 1, step))
        width++;
    const bool is_grid = width >= LEAST_WIDTH && width < MOST_WIDTH && 2 * width < rays->count &&
                         ends_row(rays, 2 * width - 1, step);
    return is_grid ? width : 0;
}

void ray_grid_order(uint32_t *order, size_t count, size_t width)
{
    size_t filled = 0, height = width > 0 ? BLOCK_ROWS : 0;
    while (height * width > count)
        height /= 2;
    const size_t side = height > 0 ? BEAM_RAYS / height : 0;
    for (size_t top = 0; height > 0 && (top + height) * width <= count; top += height)
        for (size_t left = 0; left < width; left += side)
            for (size_t y = top; y < top + height; y++)
                for (size_t x = left; x < left + side && x < width; x++)
                    order[filled++] = (uint32_t)(y * width + x);
    for (; filled < count; filled++)
        order[filled] = (uint32_t)filled;
}
