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

// The first LADDER_SAMPLES points of Sobol's sequence (host/refine/pixel_requests.h).
constant uint point_x[LADDER_SAMPLES] = {0,  512, 256, 768, 128, 640, 384, 896,
                                         64, 576, 320, 832, 192, 704, 448, 960};
constant uint point_y[LADDER_SAMPLES] = {0,   512, 768, 256, 640, 128, 384, 896,
                                         960, 448, 192, 704, 320, 832, 576, 64};

#if CLRT_LANES == 1
#define LOAD_LANES(words) (*(words))
#else
#define LOAD_LANES(words) FOR_LANES(vload)(0, words)
#endif

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
    const Count x = LOAD_LANES(point_x + first) ^ request->offset_x;
    const Count y = LOAD_LANES(point_y + first) ^ request->offset_y;
    return (PixelSamples){request->x, request->y, 2 * x + 1, 2 * y + 1, (Truth)(-1)};
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

static inline LongCount squares_of(Real3 color)
{
    return square_of(color.x) + square_of(color.y) + square_of(color.z);
}

static inline ulong sum_of_lanes(LongCount lanes)
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

static inline void store_centers(global PixelSums *sums, Real3 color, uint count)
{
    const Scalar *red = (const Scalar *)&color.x, *green = (const Scalar *)&color.y,
                 *blue = (const Scalar *)&color.z;
    for (uint lane = 0; lane < min((uint)CLRT_LANES, count); lane++)
        sums[lane] = (PixelSums){{(ulong)red[lane], (ulong)green[lane], (ulong)blue[lane]}, 0};
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
    const bool are_centers = requests[begin].offset_x == NOTHING;
    const uint samples = are_centers ? 1 : LADDER_SAMPLES;
    Tally tally = {0};
    PixelSums sum = {{0, 0, 0}, 0};
    for (uint start = 0; start < samples * count; start += CLRT_LANES) {
        const uint number = begin + start / samples;
        const PixelSamples packet = are_centers
                                        ? center_samples(requests, number, begin + count)
                                        : request_samples(&requests[number], start % samples);
        const Real3 color = pixel_sample_color(&scene, &frame, &packet, &tally);
        if (are_centers) {
            store_centers(sums + number, color, begin + count - number);
            continue;
        }
        add_samples(&sum, color);
        if ((start + CLRT_LANES) % LADDER_SAMPLES == 0) {
            sums[number] = sum;
            sum = (PixelSums){{0, 0, 0}, 0};
        }
    }
    if (CLRT_STATISTICS)
        store_tally(tallies + (size_t)begin * TALLY_KINDS, &tally);
}
