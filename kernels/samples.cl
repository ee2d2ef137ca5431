// SPDX-License-Identifier: MIT
// The kernel of adaptive anti-aliasing samples listed places instead of a tile. It is compiled
// after render.cl, and only if requested.

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

// Samples per work-item, taken one packet after another.
#if CLRT_LANES == 1
#define ITEM_SAMPLES 1
#else
#define ITEM_SAMPLES (PACKET_SIDE * PACKET_SIDE)
#endif

// Samples places first to end - 1 into the same elements of samples. A place is two coordinates in
// sub-pixels; the coordinate NOTHING skips it. A work-item takes ITEM_SAMPLES consecutive places.
// Tallies are written at the first place of each packet, and only if statistics are compiled in.
kernel void trace_samples(TRACER_ARGUMENTS, global const uint *places, uint first, uint end,
                          global SampleData *samples, global uint *tallies)
{
    const uint begin = first + ITEM_SAMPLES * (uint)get_global_id(0);
    for (uint start = begin; start < min(begin + ITEM_SAMPLES, end); start += CLRT_LANES) {
        const UInt number = start + LANE_Y * PACKET_WIDTH + LANE_X;
        const UInt word = 2 * min(number, (UInt)(end - 1));
        const UInt x = gather(places, word), y = gather(places, word + 1);
        const Places asked = {x, y, number < end && x != NOTHING};
        Tally tally = {0};
        const Tracer tracer = TRACER(&tally);
        const Real3 color = scaled3(0x1p-32f, sample_color(&tracer, &asked));
        for (uint lane = 0; lane < min((uint)CLRT_LANES, end - start); lane++)
            store_sample(samples + start + lane, &color, tally.signature, lane);
        if (CLRT_STATISTICS)
            store_tally(tallies + (size_t)start * TALLY_KINDS, &tally);
    }
}
