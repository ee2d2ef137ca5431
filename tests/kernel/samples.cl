// SPDX-License-Identifier: MIT
// Returns the positions of ladder.cl's samples to test_samples.c. probe.c appends this file to
// ladder.cl.

// All requests have *samples samples. places receives pairs {x, y}.
kernel void probe_places(global const PixelRequest *requests, global const uint *samples,
                         global uint *places)
{
    const uint item = get_global_id(0), count = get_global_size(0);
    const PixelSamples sample = samples_of(requests, *samples, item, count);
    places[2 * item] = sample.x;
    places[2 * item + 1] = sample.y;
}
