// SPDX-License-Identifier: MIT
// A picture whose pixels climb a ladder of samples: the center alone, then 4, 8, 16 ... 1024
// points of a per-pixel sequence. Strata decide how many pixels advance, and hashes of pixel
// positions decide which. The picture therefore depends neither on the order of work nor on the
// device.
#pragma once

#include "base/array.h"
#include "base/thread_pool.h"
#include "image/framebuffer.h"
#include "refine/ladder_strata.h"
#include "render/renderer.h"

// Traces requests for samples of pixels, in lists of bounded size, and returns the sums of the
// samples.

// The most requests per list.
#define REQUESTS_MOST (1u << 18)

typedef struct {
    Renderer *renderer;             // of KERNEL_LADDER; borrowed
    FrameData frame;                // with a camera made for LADDER_GRID samples
    const RenderObserver *observer; // borrowed; may be NULL
    ThreadPool *pool;               // borrowed; NULL for none
    PixelRequest *requests;         // REQUESTS_MOST entries, of which count are in use; all
                                    // have the same number of samples
    PixelSums *sums;                // of the requests traced last
    uint32_t count;
} PixelRequests;

bool pixel_requests_make(PixelRequests *requests, Error *error);
void pixel_requests_free(PixelRequests *requests);

// Returns a request for samples first to first + samples - 1 of a pixel. samples is 4 or
// REQUEST_SAMPLES, and first is a multiple of samples. The positions are points of the
// two-dimensional Sobol sequence, XORed with the low bits of hash (Sobol, "On the distribution of
// points in a cube and the approximate evaluation of integrals", 1967).
PixelRequest pixel_request(const uint32_t pixel[2], uint32_t first, uint32_t samples,
                           uint64_t hash);

// Returns whether the last trace completed without a stop by the observer.
bool pixel_requests_are_whole(const PixelRequests *requests);

// Traces the requests and stores their sums. If the observer stops it, some sums are missing.
bool pixel_requests_trace(PixelRequests *requests, Error *error);

// Renders a picture of the frame's size with one sample at each pixel's center.
bool pixel_requests_draw_centers(PixelRequests *requests, Framebuffer *picture, Error *error);

// Computes the mean color of that many samples, which are a power of two.
void pixel_sums_mean(const PixelSums *sums, uint32_t samples, float color[3]);

// Returns the variance of that many samples, averaged over the channels.
double pixel_sums_variance(const PixelSums *sums, uint32_t samples);

void pixel_sums_add(PixelSums *sums, const PixelSums *more);

// The longest side of a picture: sub-pixel positions must fit into 31 bits.
#define LADDER_SIDE_MOST   (1u << 19)
#define LADDER_PIXELS_MOST ((uint64_t)1 << 31)

// A pixel has a feature on rung 0 and sums above.
typedef union {
    float feature; // for its stratum
    uint32_t sums; // index in Ladder::sums
} LadderPlace;

typedef struct {
    PixelRequests requests;
    Framebuffer *picture;  // borrowed; means of the pixels' samples
    uint32_t *chosen;      // room for all pixels
    LadderPlace *places;   // of each pixel
    uint8_t *strata;       // of each pixel
    ARRAY(PixelSums) sums; // of the pixels above rung 0
    Strata statistics;
    Strata chosen_by; // the statistics of the last choice of pixels
    uint64_t samples; // taken
} Ladder;

typedef struct {
    Renderer *renderer;             // of KERNEL_LADDER
    const CameraData *camera;       // made for LADDER_GRID samples
    ThreadPool *pool;               // threads for the work, NULL for none
    Framebuffer *picture;           // of the renderer's size; the ladder renders into it
    const RenderObserver *observer; // may stop it; or NULL
} LadderSetup;

// Takes one sample per pixel. Fails if the picture exceeds LADDER_SIDE_MOST or LADDER_PIXELS_MOST.
bool ladder_open(Ladder *ladder, const LadderSetup *setup, Error *error);
void ladder_close(Ladder *ladder);

// Advances the pixels selected by their stratum's fraction by one rung. Stores their number in
// *advanced. If the observer stops it, some of them have not advanced.
bool ladder_advance(Ladder *ladder, uint64_t *advanced, Error *error);

// Returns the number of samples that a pixel has taken.
uint32_t ladder_pixel_samples(const Ladder *ladder, size_t pixel);

// Assigns all pixels to strata of rung 0, after their centers are drawn.
bool ladder_enter(Ladder *ladder, Error *error);

// Selects pixels.

// Seeds of a pixel's hashes: SCRAMBLE_SEED for its samples, RUNG_SEED + rung for its selection on a
// rung.
#define SCRAMBLE_SEED 0
#define RUNG_SEED     1

uint64_t ladder_hash(uint32_t pixel, uint64_t seed);

// Fills ladder->chosen with the pixels that their strata's fractions select. Stores their number.
bool ladder_choose(Ladder *ladder, uint64_t *count, Error *error);

// Advances the pixels of a ladder until the picture meets an error goal, or until a time budget is
// spent.

// The root mean square error of the picture's values, before they are rounded for a file.
typedef struct {
    double estimate;
    double bound; // the error is lower with 95 % confidence
    bool reached;
} GoalOutcome;

// Refines until the bound is at most `most`, or until no further samples would lower it.
bool goal_reach_error(Ladder *ladder, double most, GoalOutcome *outcome, Error *error);

// A time budget, on the clock of clock_seconds.
typedef struct {
    double start, seconds;
} GoalTime;

// Refines until time->seconds have passed since the start.
bool goal_spend_time(Ladder *ladder, const GoalTime *time, GoalOutcome *outcome, Error *error);

// Measures how much each pixel of a picture with one sample per pixel bends away from its
// neighbors.

// Fills bends with a value for each pixel, row by row: twice the largest difference of one of its
// colors from the mean of two opposite neighbors, as a fraction. Neighbors outside of the picture
// do not count.
void bends_measure(const Framebuffer *picture, ThreadPool *pool, float *bends);

// Fills nearby with the largest bend of the 5 x 5 pixels around each pixel.
void bends_spread(const Framebuffer *picture, ThreadPool *pool, const float *bends, float *nearby);
