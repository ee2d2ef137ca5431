// SPDX-License-Identifier: MIT
// The kernel of error and time goals. It answers requests for samples of pixels with the sums of
// these samples. It is compiled after render.cl, and only if requested.
//
// A pixel's samples are points of Sobol's two-dimensional sequence ("On the distribution of points
// in a cube and the approximate evaluation of integrals", 1967). If a pixel is divided into 2^k
// equal rectangles whose sides are powers of two, each rectangle holds one of the first 2^k points.
// Further samples therefore lie in the gaps between earlier ones.
//
// Owen's scrambling keeps this property ("Randomly permuted (t,m,s)-nets and (t,s)-sequences",
// 1995). Its random numbers are hashes of the pixel. If one random number per pixel were XORed with
// all points instead, stripes about as fine as the samples would alias. Smooth waves would take 2.6
// times as many samples for an error of 0.2 %.

// The number of samples per work-item. If the number of requests were limited instead, a work-item
// could take 1024 samples, and short lists would leave cores idle.
#define ITEM_SAMPLES (BLOCK * BLOCK)

// Color values are rounded to this many bits before squaring, so that the sum of squares of
// LADDER_GRID samples fits into 64 bits.
#define SQUARED_BITS 24

// The samples of a packet: their pixels, and positions within these pixels in half sub-pixels.
typedef struct {
    UInt pixel_x, pixel_y, x, y;
    Mask active;
} PixelSamples;

#if CLRT_LANES == 1
#define LANE_NUMBER 0
#else
#define LANE_NUMBER (LANE_Y * PACKET_WIDTH + LANE_X)
#endif

// Returns a hash of the bits (Wellons, "Prospecting for hash functions", 2018).
static inline UInt mixed(UInt bits)
{
    bits = (bits ^ bits >> 16) * 0x21f0aaadu;
    bits = (bits ^ bits >> 15) * 0xd35a2d97u;
    return bits ^ bits >> 15;
}

// Flips each bit by a hash of the seed and of the bits below it (Laine and Karras, "Stratified
// sampling for stochastic transparency", 2011). The constants are from Vegdahl, "Building a better
// LK hash", 2021.
static inline UInt scrambled(UInt bits, UInt seed)
{
    bits ^= bits * 0x3d20adeau;
    bits = (bits + seed) * (seed >> 16 | 1);
    bits ^= bits * 0x05526c56u;
    return bits ^ bits * 0x53a22864u;
}

// Returns a coordinate below LADDER_GRID from its bits in reverse order.
static inline UInt reversed(UInt bits)
{
    bits = (bits & 0x5555) << 1 | (bits >> 1 & 0x5555);
    bits = (bits & 0x3333) << 2 | (bits >> 2 & 0x3333);
    bits = (bits & 0x0f0f) << 4 | (bits >> 4 & 0x0f0f);
    bits = (bits & 0x00ff) << 8 | (bits >> 8 & 0x00ff);
    return bits / (0x10000 / LADDER_GRID);
}

// Returns the bits of a point's y in reverse order; the reversed bits of x are `point` itself. Bit
// i is the sum modulo 2 of the bits k of `point` for which the binomial coefficient "k choose i" is
// odd.
static inline UInt sobol_y(UInt point)
{
    point ^= point >> 1 & 0x5555;
    point ^= point >> 2 & 0x3333;
    point ^= point >> 4 & 0x0f0f;
    return point ^ (point >> 8 & 0x00ff);
}

// Moves each sample to the point with this number in its pixel's sequence.
static inline void place_samples(PixelSamples *samples, UInt point)
{
    const UInt seed = mixed(samples->pixel_x + mixed(samples->pixel_y));
    samples->x = 2 * reversed(scrambled(point, seed)) + 1;
    samples->y = 2 * reversed(scrambled(sobol_y(point), mixed(seed))) + 1;
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
    PixelSamples result = {gather(words, word), gather(words, word + 1), (UInt)(LADDER_GRID),
                           (UInt)(LADDER_GRID), sample < end};
    if (samples > 1)
        place_samples(&result, gather(words, word + 2) + (present & (samples - 1)));
    return result;
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

// A packet's place: its first sample is number `start` of the work-item's `count` samples. A
// request has `samples` samples.
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
// have the same number of samples. A work-item serves requests for up to ITEM_SAMPLES samples in
// total, or one larger request. With CLRT_TALLIES, the work-item stores its tally at the index of
// its first request.
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
    if (CLRT_TALLIES)
        store_tally(tallies + (size_t)begin * TALLY_KINDS, &tally);
}
