// SPDX-License-Identifier: MIT
// The kernel of error and time goals: requests for samples of pixels -> the sums of these samples.
// It is compiled after render.cl, and only if requested.

// The number of samples per work-item. If the number of requests were limited instead, a work-item
// could take 1024 samples, and short lists would leave cores idle.
#define ITEM_SAMPLES (BLOCK * BLOCK)

// Color values are rounded to this many bits before squaring, so that the sum of squares of
// LADDER_GRID samples fits into 64 bits.
#define SQUARED_BITS 24

// The samples of a packet: pixels, and positions within them in halves of a sub-pixel.
typedef struct {
    UInt pixel_x, pixel_y, x, y;
    Mask active;
} PixelSamples;

#if CLRT_LANES == 1
#define LANE_NUMBER 0
#else
#define LANE_NUMBER (LANE_Y * PACKET_WIDTH + LANE_X)
#endif

// Returns `value` in lanes whose number has this bit set, and 0 in the others.
static inline UInt times_bit(UInt number, uint bit, uint value)
{
    return (number >> bit & 1) * value;
}

// These functions return coordinates of the first 16 points of Sobol's sequence
// (host/refine/ladder_requests.h).
static inline UInt point_x(UInt point)
{
    return times_bit(point, 0, 512) | times_bit(point, 1, 256) | times_bit(point, 2, 128) |
           times_bit(point, 3, 64);
}

static inline UInt point_y(UInt point)
{
    return times_bit(point, 0, 512) ^ times_bit(point, 1, 768) ^ times_bit(point, 2, 640) ^
           times_bit(point, 3, 960);
}

// Returns the samples with the numbers `start` to `start` + CLRT_LANES - 1 of a list of requests.
// All requests have the same number of samples, a power of two. With divisions instead of shifts,
// pictures took 3 to 5 % longer.
static inline PixelSamples samples_of(global const PixelRequest *requests, uint samples, uint start,
                                      uint end)
{
    const UInt sample = start + LANE_NUMBER, present = min(sample, (UInt)(end - 1));
    const uint samples_log2 = 31 - clz(samples);
    const UInt word = (present >> samples_log2) * (uint)(sizeof(PixelRequest) / sizeof(uint));
    global const uint *words = (global const uint *)requests;
    const UInt offset = gather(words, word + 2), point = present & (samples - 1);
    const bool is_center = samples == 1;
    const UInt x = point_x(point) ^ offset % LADDER_GRID;
    const UInt y = point_y(point) ^ offset / LADDER_GRID;
    return (PixelSamples){gather(words, word), gather(words, word + 1),
                          is_center ? (UInt)(LADDER_GRID) : 2 * x + 1,
                          is_center ? (UInt)(LADDER_GRID) : 2 * y + 1, sample < end};
}

static NOT_INLINE void pixel_sample_colors(const Tracer *tracer,
                                           const PixelSamples samples[PACKETS],
                                           Real3 colors[PACKETS])
{
    Paths paths;
    for (uint i = 0; i < PACKETS; i++)
        paths_start(&paths, i,
                    camera_ray_toward(
                        tracer->frame, 2 * LADDER_GRID * samples[i].pixel_x + samples[i].x,
                        2 * LADDER_GRID * samples[i].pixel_y + samples[i].y, samples[i].active));
    trace(tracer, &paths, colors);
}

static inline ULong square_of(Real steps)
{
    const ULong value = to_long(rint(steps * (1.0f / (1u << (32 - SQUARED_BITS)))));
    return value * value;
}

static inline ULong squares_of(Real3 color)
{
    return square_of(color.x) + square_of(color.y) + square_of(color.z);
}

static inline ulong sum_of_lanes(ULong lanes)
{
    ulong sum = 0;
    for (uint lane = 0; lane < CLRT_LANES; lane++)
        sum += ((const ulong *)&lanes)[lane];
    return sum;
}

static inline void add_samples(PixelSums *sums, Real3 color)
{
    sums->colors[0] += sum_of_lanes(to_long(color.x));
    sums->colors[1] += sum_of_lanes(to_long(color.y));
    sums->colors[2] += sum_of_lanes(to_long(color.z));
    sums->squares += sum_of_lanes(squares_of(color));
}

// Stores the sums of all requests that lie entirely within a packet.
static inline void store_sums(global PixelSums *sums, Real3 color, uint samples, uint count)
{
    const ULong red = to_long(color.x), green = to_long(color.y), blue = to_long(color.z);
    const ULong squares = squares_of(color);
    PixelSums sum = {{0, 0, 0}, 0};
    for (uint lane = 0; lane < min((uint)CLRT_LANES, count); lane++) {
        sum.colors[0] += ((const ulong *)&red)[lane];
        sum.colors[1] += ((const ulong *)&green)[lane];
        sum.colors[2] += ((const ulong *)&blue)[lane];
        sum.squares += ((const ulong *)&squares)[lane];
        if ((lane + 1) % samples != 0)
            continue;
        sums[lane / samples] = sum;
        sum = (PixelSums){{0, 0, 0}, 0};
    }
}

// `start` is a packet's first of the work-item's `count` samples. A request has `samples` samples.
typedef struct {
    uint samples, start, count;
} Span;

// Adds a packet's colors to the sums of its requests. `sum` holds the partial sums of a request
// that spans several packets.
static inline void add_packet(global PixelSums *sums, PixelSums *sum, Real3 color, Span span)
{
    global PixelSums *place = sums + span.start / span.samples;
    if (span.start >= span.count)
        return;
    if (span.samples < CLRT_LANES) {
        store_sums(place, color, span.samples, span.count - span.start);
        return;
    }
    add_samples(sum, color);
    if ((span.start + CLRT_LANES) % span.samples == 0) {
        *place = *sum;
        *sum = (PixelSums){{0, 0, 0}, 0};
    }
}

// Stores the sums of the requests `first` to `end` - 1 at the same indices of `sums`. All requests
// have the same number of samples. A work-item serves requests for ITEM_SAMPLES samples in total,
// or one larger request. If statistics are compiled in, the work-item stores its tally at the
// index of its first request.
kernel void trace_pixels(TRACER_ARGUMENTS, global const PixelRequest *requests, uint first,
                         uint end, global PixelSums *sums, global uint *tallies)
{
    const uint samples = requests[first].samples;
    const uint item_requests = max(ITEM_SAMPLES / samples, 1u);
    const uint begin = first + item_requests * (uint)get_global_id(0);
    if (begin >= end)
        return;
    const uint count = samples * min(end - begin, item_requests);
    Tally tally = {0};
    const Tracer tracer = TRACER(&tally);
    PixelSums sum = {{0, 0, 0}, 0};
    for (uint start = 0; start < count; start += PACKETS * CLRT_LANES) {
        PixelSamples asked[PACKETS];
        Real3 colors[PACKETS];
        for (uint i = 0; i < PACKETS; i++)
            asked[i] = samples_of(requests + begin, samples, start + i * CLRT_LANES, count);
        pixel_sample_colors(&tracer, asked, colors);
        for (uint i = 0; i < PACKETS; i++)
            add_packet(sums + begin, &sum, colors[i],
                       (Span){samples, start + i * CLRT_LANES, count});
    }
    if (CLRT_STATISTICS)
        store_tally(tallies + (size_t)begin * TALLY_KINDS, &tally);
}
