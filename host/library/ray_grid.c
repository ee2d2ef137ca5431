// SPDX-License-Identifier: MIT
#include "library/ray_grid.h"

#include "library/given_ray.h"

// The most rays of a beam, the largest height of a block, and the bounds of a row's length.
#define BEAM_RAYS   64
#define BLOCK_ROWS  8
#define LEAST_WIDTH 16
#define MOST_WIDTH  8192

static Vec3 step_after(const ClrtRays *rays, size_t index)
{
    const GivenRay a = given_ray(rays, index), b = given_ray(rays, index + 1);
    return vec3_sub(vec3_add(b.origin, b.direction), vec3_add(a.origin, a.direction));
}

// Returns whether a row ends at the ray. `step` leads from the first ray of the row to the second.
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

// A rectangle of a grid.
typedef struct {
    size_t left, top, width, height;
} Rectangle;

// Appends the numbers of the rectangle's rays to the order, which has `filled` numbers. Returns the
// new count of numbers.
static size_t append(uint32_t *order, size_t filled, size_t grid_width, Rectangle part)
{
    for (size_t y = part.top; y < part.top + part.height; y++)
        for (size_t x = part.left; x < part.left + part.width; x++)
            order[filled++] = (uint32_t)(y * grid_width + x);
    return filled;
}

void ray_grid_order(uint32_t *order, size_t count, size_t width)
{
    size_t filled = 0, height = width > 0 ? BLOCK_ROWS : 1;
    while (height > 1 && height * width > count)
        height /= 2;
    const size_t side = BEAM_RAYS / height, rows = height > 1 ? count / width / height * height : 0;
    for (size_t top = 0; top < rows; top += height)
        for (size_t left = 0; left + side <= width; left += side)
            filled = append(order, filled, width, (Rectangle){left, top, side, height});
    const size_t rest = width > 0 ? width % side : 0;
    filled = append(order, filled, width, (Rectangle){width - rest, 0, rest, rows});
    for (; filled < count; filled++)
        order[filled] = (uint32_t)filled;
}
