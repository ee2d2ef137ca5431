// SPDX-License-Identifier: MIT
// Refines a picture for error and time goals. Each pixel climbs a ladder of samples: its center,
// then 4, 8, 16 ... 1024 points of its own sequence. Statistics of similar pixels decide how many
// pixels advance, and hashes of pixel positions decide which. With an error goal, the picture
// therefore depends neither on the order of work nor on the device.
#pragma once

#include "base/array.h"
#include "base/thread_pool.h"
#include "image/framebuffer.h"
#include "refine/ladder_strata.h"
#include "render/sampler.h"
#include "scene/normalize.h"

// The functions below trace lists of requests for samples of pixels, and sum the samples.

// The most requests per list.
#define REQUESTS_MOST (1u << 18)

typedef struct {
    Renderer *renderer;             // with ladder_entry; borrowed
    FrameData frame;                // with a camera made for LADDER_GRID samples
    const RenderObserver *observer; // borrowed; may be NULL
    ThreadPool *pool;               // borrowed; NULL for none
    PixelRequest *requests;         // room for REQUESTS_MOST, all with equal sample counts
    PixelSums *sums;                // of the requests in the latest trace
    uint32_t count;                 // requests in the list
} PixelRequests;

bool pixel_requests_make(PixelRequests *requests, Error *error);
void pixel_requests_free(PixelRequests *requests);

// Returns a request for samples first to first + samples - 1 of a pixel. samples is 4 or
// REQUEST_SAMPLES, and first is a multiple of samples. The sample positions are points of the
// two-dimensional Sobol sequence, XORed with the low bits of hash (Sobol, "On the distribution of
// points in a cube and the approximate evaluation of integrals", 1967).
PixelRequest pixel_request(const uint32_t pixel[2], uint32_t first, uint32_t samples,
                           uint64_t hash);

// Returns false if the observer has stopped a trace.
bool pixel_requests_are_whole(const PixelRequests *requests);

// Traces the requests and stores their sums. If the observer stops the trace, some are missing.
bool pixel_requests_trace(PixelRequests *requests, Error *error);

// Renders a picture of the frame's size with one sample at each pixel's center.
bool pixel_requests_draw_centers(PixelRequests *requests, Framebuffer *picture, Error *error);

// Computes the mean color of the samples. Their number is a power of two.
void pixel_sums_mean(const PixelSums *sums, uint32_t samples, float color[3]);

// Returns the variance of the samples' colors, averaged over the channels.
double pixel_sums_variance(const PixelSums *sums, uint32_t samples);

void pixel_sums_add(PixelSums *sums, const PixelSums *more);

// The longest side of a picture, so that sub-pixel positions fit into 31 bits.
#define LADDER_SIDE_MOST   (1u << 19)
#define LADDER_PIXELS_MOST ((uint64_t)1 << 31)

// On rung 0, a pixel has a feature (ladder_strata.h). On higher rungs, it has sums of samples.
typedef union {
    float feature;
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
    Strata chosen_by; // the statistics at the latest selection of pixels
    uint64_t samples; // taken so far
} Ladder;

typedef struct {
    Renderer *renderer;       // with ladder_entry
    const FlatScene *flat;    // the renderer's scene
    const CameraData *camera; // made for LADDER_GRID samples
    ThreadPool *pool;         // threads for the work, NULL for none
    const Scene *scene;       // the source of flat
    const Normalization *normalization;
    Framebuffer *picture;           // of the renderer's size; the ladder renders into it
    const RenderObserver *observer; // may stop the refinement; may be NULL
} LadderSetup;

// Makes a ladder with one sample per pixel. Fails if the picture exceeds LADDER_SIDE_MOST or
// LADDER_PIXELS_MOST.
bool ladder_open(Ladder *ladder, const LadderSetup *setup, Error *error);
void ladder_close(Ladder *ladder);

// Selects pixels by the strata's fractions, and moves each to its next rung. Stores the number of
// selected pixels in *advanced. If the observer stops the trace, some of them have not moved.
bool ladder_advance(Ladder *ladder, uint64_t *advanced, Error *error);

// Returns the number of samples taken in a pixel.
uint32_t ladder_pixel_samples(const Ladder *ladder, size_t pixel);

// Assigns all pixels to strata of rung 0. The pixels' centers must be drawn.
bool ladder_enter(Ladder *ladder, const LadderSetup *setup, Error *error);

// Seeds of a pixel's hashes: SCRAMBLE_SEED for its samples, RUNG_SEED + rung for its selection on a
// rung.
#define SCRAMBLE_SEED 0
#define RUNG_SEED     1

uint64_t ladder_hash(uint32_t pixel, uint64_t seed);

// Fills ladder->chosen with the pixels that the strata's fractions select, and stores their number.
bool ladder_choose(Ladder *ladder, uint64_t *count, Error *error);

// Goals: a ladder's pixels advance until the picture meets an error goal, or until a time budget is
// spent.

// The root mean square error of the picture's values, before they are rounded for a file.
typedef struct {
    double estimate;
    double bound; // the error is lower with 95 % confidence
    bool reached;
} GoalOutcome;

// Refines until the bound is at most `most`, no pixel can advance, or too many rounds have passed.
bool goal_reach_error(Ladder *ladder, double most, GoalOutcome *outcome, Error *error);

// A time budget, on the clock of clock_seconds.
typedef struct {
    double start, seconds;
} GoalTime;

// Refines until about time->seconds have passed since time->start, or no pixel can advance.
bool goal_spend_time(Ladder *ladder, const GoalTime *time, GoalOutcome *outcome, Error *error);

// The bend of a pixel measures how far its color is from the means of opposite neighbors.

// Fills bends, row by row, for a picture with one sample per pixel. A pixel's bend is the largest
// |2 c - a - b|, where c is a channel of the pixel, and a and b are this channel of two opposite
// neighbors. Pairs of neighbors partly outside of the picture do not count.
void bends_measure(const Framebuffer *picture, ThreadPool *pool, float *bends);

// Fills nearby with the largest bend of the 5 x 5 pixels around each pixel.
void bends_spread(const Framebuffer *picture, ThreadPool *pool, const float *bends, float *nearby);
