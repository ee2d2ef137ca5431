// SPDX-License-Identifier: MIT
// A kernel for test_samples.c, which stores the positions of a pixel's samples. probe.c appends
// this file to kernels/samples.cl.

// All requests have *samples samples. places receives pairs {x, y}, relative to the pixel.
kernel void probe_places(global const PixelRequest *requests, global const uint *samples,
                         global uint *places)
{
    const uint item = get_global_id(0), count = get_global_size(0);
    const PixelRequest request = requests[item / *samples];
    const Places place = points_at((global const uint *)requests, *samples, item, count);
    places[2 * item] = place.x - 2 * LADDER_GRID * request.x;
    places[2 * item + 1] = place.y - 2 * LADDER_GRID * request.y;
}
