// SPDX-License-Identifier: MIT
// The kernel for adaptive pictures, and for error and time goals. It traces lists of samples, and
// renders tiles with one sample per pixel. It is compiled after render.cl, and only if requested.
//
// With CLRT_PLACES, a request is a place in the picture, and its result is a sample's color.
// Otherwise, a request is for some samples of a pixel, and its result has the sums of these
// samples.
//
// A pixel's samples are points of Sobol's two-dimensional sequence ("On the distribution of points
// in a cube and the approximate evaluation of integrals", 1967). If a pixel is divided into 2^k
// equal rectangles whose sides are powers of two, each rectangle holds one of the first 2^k points.
// Further samples therefore lie in the gaps between earlier ones.
//
// Owen's scrambling keeps this property ("Randomly permuted (t,m,s)-nets and (t,s)-sequences",
// 1995). The random numbers of the scrambling are hashes of the pixel's position. If all points of
// a pixel were XORed with one random number instead, stripes about as fine as the samples would
// alias. For an error of 0.2 %, smooth waves would then take 2.6 times as many samples.
#include "pixels.cl"

// The number of samples per work-item, unless a request has more.
#define ITEM_SAMPLES (BLOCK * BLOCK)

// The numbers of small and of large requests per work-item.
#define ITEM_SMALL (ITEM_SAMPLES > SMALL_SAMPLES ? ITEM_SAMPLES / SMALL_SAMPLES : 1)
#define ITEM_LARGE (ITEM_SAMPLES > LARGE_SAMPLES ? ITEM_SAMPLES / LARGE_SAMPLES : 1)

// The number of words of a request, and of a result.
#define REQUEST_WORDS ((CLRT_PLACES ? sizeof(SamplePlace) : sizeof(PixelRequest)) / sizeof(uint))
#define RESULT_WORDS  ((CLRT_PLACES ? sizeof(SampleData) : sizeof(PixelSums)) / sizeof(float))

// Color values are rounded to this many bits before squaring, so that the sum of squares of
// LADDER_GRID samples fits into 64 bits.
#define SQUARED_BITS 24

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

// Returns the bits of a point's y in reverse order. The bits of its x in reverse order are `point`.
// Bit i of the result is the sum modulo 2 of the bits k of `point` for which the binomial
// coefficient "k choose i" is odd.
static inline UInt sobol_y(UInt point)
{
    point ^= point >> 1 & 0x5555;
    point ^= point >> 2 & 0x3333;
    point ^= point >> 4 & 0x0f0f;
    return point ^ (point >> 8 & 0x00ff);
}

// Returns the samples with the numbers `start` to `start` + CLRT_LANES - 1 of a list of requests,
// in half sub-pixels of the whole picture. All requests have the same number of samples, a power of
// two. With divisions instead of shifts, pictures took 3 to 5 % longer.
static inline Places points_at(global const uint *words, uint samples, uint start, uint end)
{
    const UInt sample = start + LANE_NUMBER, present = min(sample, (UInt)(end - 1));
    const uint samples_log2 = 31 - clz(samples);
    const UInt word = (present >> samples_log2) * (uint)(sizeof(PixelRequest) / sizeof(uint));
    const UInt x = gather(words, word), y = gather(words, word + 1);
    const UInt point = gather(words, word + 2) + (present & (samples - 1));
    const UInt seed = mixed(x + mixed(y));
    return (Places){2 * (LADDER_GRID * x + reversed(scrambled(point, seed))) + 1,
                    2 * (LADDER_GRID * y + reversed(scrambled(sobol_y(point), mixed(seed)))) + 1,
                    sample < end};
}

// Returns the places with these numbers of a list of SamplePlace, in half sub-pixels.
static inline Places places_listed(global const uint *words, uint start, uint end)
{
    const UInt number = start + LANE_NUMBER, word = 2 * min(number, (UInt)(end - 1));
    return (Places){2 * gather(words, word) + 1, 2 * gather(words, word + 1) + 1, number < end};
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

// The samples of a work-item: `samples` of each request, or the centers of a block of the tile.
typedef struct {
    global const uint *requests;
    global float *results; // of the requests or of the tile
    bool has_tile;
    uint2 block;         // top left pixel
    uint samples, count; // of a request, and of all requests together
} Item;

// Returns the top left pixel of block `number`. Blocks are numbered row by row.
static inline uint2 tile_block(const FrameData *frame, uint number)
{
    const uint columns = (frame->tile_width + BLOCK - 1) / BLOCK;
    return BLOCK * (uint2)(number % columns, number / columns);
}

// Returns the top left pixel of the block's packet whose first sample has the number `start`.
static inline uint2 corner_at(uint2 block, uint start)
{
    const uint beam = start / (PACKETS * CLRT_LANES), columns = BLOCK / BEAM_WIDTH;
    const uint2 place = (uint2)(beam % columns * BEAM_WIDTH, beam / columns * BEAM_HEIGHT);
    return packet_corner(block + place, start / CLRT_LANES % PACKETS);
}

// Returns the places of a packet. The packet starts at sample number `start` of the item.
static inline Places packet_places(const FrameData *frame, const Item *item, uint start)
{
    if (!item->has_tile)
        return CLRT_PLACES ? places_listed(item->requests, start, item->count)
                           : points_at(item->requests, item->samples, start, item->count);
    const Places pixels = places_at(frame, corner_at(item->block, start));
    return (Places){(2 * pixels.x + 1) * frame->samples, (2 * pixels.y + 1) * frame->samples,
                    pixels.active};
}

// Adds a packet's colors to the sums of its requests. `sum` holds the partial sums of a request
// that spans several packets.
static inline void add_packet(const Item *item, uint start, Real3 color, PixelSums *sum)
{
    global PixelSums *place = (global PixelSums *)item->results + start / item->samples;
    if (start >= item->count)
        return;
    if (item->samples < CLRT_LANES) {
        store_sums(place, color, item->samples, item->count - start);
        return;
    }
    add_samples(sum, color);
    if ((start + CLRT_LANES) % item->samples == 0) {
        *place = *sum;
        *sum = (PixelSums){{0, 0, 0}, 0};
    }
}

// Stores the colors of a packet of listed places.
static inline void store_samples(const Item *item, uint start, const Real3 *color)
{
    for (uint lane = 0; lane < CLRT_LANES && start + lane < item->count; lane++)
        store_lane(item->results + 3 * (start + lane), color, lane);
}

// Stores the results of a packet.
static inline void store_packet(const FrameData *frame, const Item *item, uint start, Real3 steps,
                                PixelSums *sum)
{
    const Real3 color = scaled3(0x1p-32f, steps);
    if (item->has_tile)
        store_colors(frame, corner_at(item->block, start), &color, item->results);
    else if (CLRT_PLACES)
        store_samples(item, start, &color);
    else
        add_packet(item, start, steps, sum);
}

static inline void trace_item(const Tracer *tracer, const Item *item)
{
    PixelSums sum = {{0, 0, 0}, 0};
    for (uint begin = 0; begin < item->count; begin += PACKETS * CLRT_LANES) {
        Places places[PACKETS];
        Real3 colors[PACKETS];
        for (uint i = 0; i < PACKETS; i++)
            places[i] = packet_places(tracer->frame, item, begin + i * CLRT_LANES);
        sample_colors(tracer, places, colors);
        for (uint i = 0; i < PACKETS; i++)
            store_packet(tracer->frame, item, begin + i * CLRT_LANES, colors[i], &sum);
    }
}

// Stores the results of a block of sky.
static NOT_INLINE void fill_block(const FrameData *frame, const Item *item)
{
    PixelSums none = {{0, 0, 0}, 0};
    const Real3 sky = in_steps3(load_private3(frame->background));
    for (uint start = 0; start < ITEM_SAMPLES; start += CLRT_LANES)
        store_packet(frame, item, start, sky, &none);
}

static inline bool is_block_of_sky(const FrameData *frame, const Item *item)
{
    if (BLOCK == 1 || !item->has_tile)
        return false;
    return !CLRT_STATISTICS && is_sky(frame, item->block.x, item->block.y);
}

// The requests of a work-item: each request's number of samples, the index of the first request,
// and the index after the last.
typedef struct {
    uint samples, begin, end;
} ItemRange;

// Returns the requests of a work-item. The list has `small` small requests and then large ones.
// `begin` is at least `end` if no requests remain.
static inline ItemRange range_of(uint number, uint small, uint end)
{
    const uint small_items = (small + ITEM_SMALL - 1) / ITEM_SMALL;
    if (number < small_items)
        return (ItemRange){SMALL_SAMPLES, number * ITEM_SMALL,
                           min(small, (number + 1) * ITEM_SMALL)};
    const uint begin = small + (number - small_items) * ITEM_LARGE;
    return (ItemRange){LARGE_SAMPLES, begin, min(end, begin + ITEM_LARGE)};
}

// Work-item `first` and the following ones store the results of their requests in `results`, at the
// requests' indices. The launch ends at index `end` of the list. With CLRT_TALLIES, a work-item
// stores its tally at the index of its first request.
//
// With CLRT_PLACES, requests are SamplePlace, and results are SampleData. Otherwise, requests are
// PixelRequest, and results are PixelSums. The list has `small` requests for SMALL_SAMPLES samples,
// and then requests for LARGE_SAMPLES.
//
// If the frame has a tile, `requests` and `small` are not used, and each index stands for a pixel's
// center. A work-item renders the centers of a block. The results are the colors of the tile's
// pixels, as in render_tile. Indices beyond the tile are padding.
kernel void trace_samples(TRACER_ARGUMENTS, global const uint *requests, uint first, uint end,
                          global float *results, global uint *tallies, uint small)
{
    const bool has_tile = frame.tile_width > 0;
    const uint number = first + (uint)get_global_id(0);
    const ItemRange range =
        has_tile || CLRT_PLACES
            ? (ItemRange){1, number * ITEM_SAMPLES, min(end, (number + 1) * ITEM_SAMPLES)}
            : range_of(number, small, end);
    if (range.begin >= range.end)
        return;
    const Item item = {requests + (size_t)range.begin * REQUEST_WORDS,
                       results + (has_tile ? 0 : (size_t)range.begin * RESULT_WORDS),
                       has_tile,
                       has_tile ? tile_block(&frame, number) : (uint2)(0),
                       range.samples,
                       range.samples * (range.end - range.begin)};
    Tally tally = {0};
    const Tracer tracer = TRACER(&tally);
    if (is_block_of_sky(&frame, &item)) {
        fill_block(&frame, &item);
        return;
    }
    trace_item(&tracer, &item);
    if (CLRT_TALLIES)
        store_tally(tallies, range.begin, &tally);
}
