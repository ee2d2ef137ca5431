// SPDX-License-Identifier: MIT
// The kernel for adaptive anti-aliasing. It computes colors and signatures for a list of places in
// the picture. It is compiled after render.cl, and only if requested.

static inline void store_sample(global SampleData *sample, const Real3 *color, UInt signature,
                                uint lane)
{
    const Scalar *red = (const Scalar *)&color->x, *green = (const Scalar *)&color->y,
                 *blue = (const Scalar *)&color->z;
    sample->color[0] = (float)red[lane];
    sample->color[1] = (float)green[lane];
    sample->color[2] = (float)blue[lane];
    sample->signature = ((const uint *)&signature)[lane];
}

// Samples per work-item.
#define ITEM_SAMPLES (BLOCK * BLOCK)

// Returns a packet's places, which start at index `start` of the list.
static inline Places places_listed(global const uint *places, uint start, uint end)
{
    const UInt number = start + LANE_Y * PACKET_WIDTH + LANE_X;
    const UInt word = 2 * min(number, (UInt)(end - 1));
    const UInt x = gather(places, word), y = gather(places, word + 1);
    return (Places){x, y, number < end && x != NOTHING};
}

// Traces rays through places, and stores the results at the same indices of `samples`. A place
// consists of the coordinates x and y in sub-pixels. If x is NOTHING, the place has no ray. A
// work-item takes ITEM_SAMPLES consecutive places. The launch starts at the work-item with the
// number `first`, and ends at index `end` of the list. With CLRT_TALLIES, a tally is stored at the
// first place of each beam.
kernel void trace_samples(TRACER_ARGUMENTS, global const uint *places, uint first, uint end,
                          global SampleData *samples, global uint *tallies)
{
    const uint begin = ITEM_SAMPLES * (first + (uint)get_global_id(0));
    const uint beam = PACKETS * CLRT_LANES;
    for (uint start = begin; start < min(begin + ITEM_SAMPLES, end); start += beam) {
        Tally tally = {0};
        const Tracer tracer = TRACER(&tally);
        Places asked[PACKETS];
        Real3 colors[PACKETS];
        for (uint i = 0; i < PACKETS; i++)
            asked[i] = places_listed(places, start + i * CLRT_LANES, end);
        sample_colors(&tracer, asked, colors);
        for (uint i = 0; i < PACKETS; i++)
            colors[i] = scaled3(0x1p-32f, colors[i]);
        for (uint i = 0; i < min(beam, end - start); i++)
            store_sample(samples + start + i, &colors[i / CLRT_LANES],
                         tally.signatures[i / CLRT_LANES], i % CLRT_LANES);
        if (CLRT_TALLIES)
            store_tally(tallies, start, &tally);
    }
}
