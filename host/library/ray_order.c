// SPDX-License-Identifier: MIT
// Programs list the rays of a picture row by row, but 64 rays of a square visit fewer nodes than 64
// rays of a row. The rays of a picture are therefore reordered into beams of 64 rays.
#include "library/ray_order.h"

// Rays in a beam, rows in a block, and the limits of the number of rays in a row.
#define BEAM_RAYS   64
#define BLOCK_ROWS  8
#define LEAST_WIDTH 16
#define MOST_WIDTH  8192

// Returns the vector from a ray's point at t = 1 to the next ray's point at t = 1.
static Vec3 step_after(const ClrtRays *rays, size_t index)
{
    const GivenRay a = given_ray(rays, index), b = given_ray(rays, index + 1);
    return vec3_sub(vec3_add(b.origin, b.direction), vec3_add(a.origin, a.direction));
}

size_t ray_order_width(const ClrtRays *rays)
{
    const size_t most = rays->count / 2 < MOST_WIDTH ? rays->count / 2 : MOST_WIDTH;
    if (most < LEAST_WIDTH)
        return 0;
    const Vec3 step = step_after(rays, 0);
    size_t width = 1;
    while (width < most && !(vec3_dot(step_after(rays, width - 1), step) < 0))
        width++;
    const bool is_grid =
        width >= LEAST_WIDTH && width < most && vec3_dot(step_after(rays, 2 * width - 1), step) < 0;
    return is_grid ? width : 0;
}

void ray_order_fill(RayBatch *batch, size_t width)
{
    size_t filled = 0, height = width > 0 ? BLOCK_ROWS : 0;
    while (height * width > batch->count)
        height /= 2;
    const size_t side = height > 0 ? BEAM_RAYS / height : 0;
    for (size_t top = 0; height > 0 && (top + height) * width <= batch->count; top += height)
        for (size_t left = 0; left < width; left += side)
            for (size_t y = top; y < top + height; y++)
                for (size_t x = left; x < left + side && x < width; x++)
                    batch->order[filled++] = (uint32_t)(y * width + x);
    for (; filled < batch->count; filled++)
        batch->order[filled] = (uint32_t)filled;
}
