// SPDX-License-Identifier: MIT
// The kernel of error and time goals: requests for samples of pixels -> sums over these samples.
// It is compiled behind render.cl, and only where it is wanted.

// Requests that a work-item answers.
#define ITEM_REQUESTS (BLOCK * BLOCK)

// Color values are rounded to this many bits before they are squared, so that the sum of the
// squares of LADDER_GRID samples fits into 64 bits.
#define SQUARED_BITS 24

// The samples of a packet: pixels, and places within them in halves of a sub-pixel.
typedef struct {
    Count pixel_x, pixel_y, x, y;
    Truth active;
} PixelSamples;

// Points of Sobol's sequence in two dimensions ("On the distribution of points in a cube and the
// approximate evaluation of integrals", 1967): x is the number with its bits reversed, and the bits
// of y are sums of binomial coefficients mod 2.  The scramble is XORed to both.
static inline void place_samples(PixelSamples *samples, Count number, Count scramble)
{
    Count x = scramble % LADDER_GRID, y = scramble / LADDER_GRID % LADDER_GRID;
    uint y_bits = LADDER_GRID / 2;
    for (uint x_bit = LADDER_GRID / 2; x_bit != 0; x_bit /= 2) {
        x ^= (number & 1) * x_bit;
        y ^= (number & 1) * y_bits;
        y_bits ^= y_bits / 2;
        number /= 2;
    }
    samples->x = 2 * x + 1;
    samples->y = 2 * y + 1;
}

static inline Count request_word(global const PixelRequest *requests, Count number, uint word)
{
    return gather((global const uint *)requests,
                  number * (uint)(sizeof(PixelRequest) / sizeof(uint)) + word);
}

// The centers of pixels, a request in each lane.
static inline PixelSamples center_samples(global const PixelRequest *requests, uint start, uint end)
{
    const Count number = start + LANE_Y * PACKET_WIDTH + LANE_X;
    const Count present = min(number, (Count)(end - 1));
    return (PixelSamples){request_word(requests, present, 0), request_word(requests, present, 1),
                          LADDER_GRID, LADDER_GRID, number < end};
}

// The samples of a request from `first` on, one in each lane.
static inline PixelSamples request_samples(global const PixelRequest *request, uint first)
{
    PixelSamples samples = {request->x, request->y, 0, 0, (Truth)(-1)};
    place_samples(&samples, request->first + first + LANE_Y * PACKET_WIDTH + LANE_X,
                  request->scramble);
    return samples;
}

// Colors in steps of 2^-32.
static inline Real3 pixel_sample_color(const SceneView *scene, const FrameData *frame,
                                       const PixelSamples *samples, Tally *tally)
{
    const Ray ray =
        camera_ray_toward(frame, 2 * LADDER_GRID * samples->pixel_x + samples->x,
                          2 * LADDER_GRID * samples->pixel_y + samples->y, samples->active);
    const Real3 color = trace(scene, frame, ray, tally);
    if (CLRT_STATISTICS)
        tally->camera_rays += lane_count(samples->active);
    return real3_of(in_steps(color.x), in_steps(color.y), in_steps(color.z));
}

static inline LongCount square_of(Real steps)
{
    const LongCount value = to_long(rint(steps * (1.0f / (1u << (32 - SQUARED_BITS)))));
    return value * value;
}

static inline ulong lane_of(LongCount lanes, uint lane)
{
    return ((const ulong *)&lanes)[lane];
}

static inline void add_lane(PixelSums *sums, Real3 color, uint lane)
{
    const LongCount squares = square_of(color.x) + square_of(color.y) + square_of(color.z);
    sums->colors[0] += lane_of(to_long(color.x), lane);
    sums->colors[1] += lane_of(to_long(color.y), lane);
    sums->colors[2] += lane_of(to_long(color.z), lane);
    sums->squares += lane_of(squares, lane);
}

// Requests first to end - 1 are answered by the same elements of sums.  All of a launch are alike:
// LADDER_SAMPLES samples each, or the center alone.  A work-item answers ITEM_REQUESTS that follow
// each other; tallies are written where they begin, and only where statistics are compiled in.
kernel void trace_pixels(const FrameData frame, global const PointLight *lights,
                         global const Material *materials, global const SphereData *spheres,
                         global const Node *nodes, global const Triangles *triangles,
                         global const TriangleLook *looks, global const CornerNormals *normals,
                         global const PixelRequest *requests, uint first, uint end,
                         global PixelSums *sums, global uint *tallies)
{
    const SceneView scene = {lights, materials, spheres, nodes, triangles, looks, normals};
    const uint begin = first + ITEM_REQUESTS * (uint)get_global_id(0);
    if (begin >= end)
        return;
    const uint count = min(end - begin, (uint)ITEM_REQUESTS);
    const bool are_centers = requests[begin].first == NOTHING;
    const uint samples = are_centers ? 1 : LADDER_SAMPLES;
    Tally tally = {0};
    PixelSums sum = {{0, 0, 0}, 0};
    for (uint start = 0; start < samples * count; start += CLRT_LANES) {
        const uint number = begin + start / samples;
        const PixelSamples packet = are_centers
                                        ? center_samples(requests, number, begin + count)
                                        : request_samples(&requests[number], start % samples);
        const Real3 color = pixel_sample_color(&scene, &frame, &packet, &tally);
        for (uint lane = 0; lane < min((uint)CLRT_LANES, samples * count - start); lane++) {
            add_lane(&sum, color, lane);
            if ((start + lane + 1) % samples != 0)
                continue;
            sums[begin + (start + lane) / samples] = sum;
            sum = (PixelSums){{0, 0, 0}, 0};
        }
    }
    if (CLRT_STATISTICS)
        store_tally(tallies + (size_t)begin * TALLY_KINDS, &tally);
}
