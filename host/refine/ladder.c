// SPDX-License-Identifier: MIT
// Runs the rounds of an error or time goal (ladder.h explains rungs and strata). A round has three
// steps. strata_raise raises the fractions of some strata. ladder_choose selects pixels by these
// fractions. climb_chosen moves the pixels up by one rung. The changes of the pixels' colors
// correct the strata's estimates for the next round.
//
// climb_chosen traces the pixels' samples and records their changes in the list's fixed order.
// Floating-point sums therefore do not depend on threads.
#include "refine/ladder.h"

#include "base/clock.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static inline uint32_t rung_of(const Ladder *ladder, size_t pixel)
{
    return strata_rung(ladder->strata[pixel]);
}

uint32_t ladder_pixel_samples(const Ladder *ladder, size_t pixel)
{
    const uint32_t rung = rung_of(ladder, pixel);
    return rung == 0 ? 1 : 1 + ladder_samples[rung];
}

static bool make_arrays(Ladder *ladder, Error *error)
{
    const size_t pixels = ladder->statistics.pixels;
    const size_t blocks = (size_t)range_count(ladder->setup.picture->width, LADDER_BLOCK) *
                          range_count(ladder->setup.picture->height, LADDER_BLOCK);
    ladder->answers = memory_raw(REQUESTS_MOST, sizeof *ladder->answers, error);
    ladder->requests = memory_raw(REQUESTS_MOST, sizeof *ladder->requests, error);
    ladder->chosen = memory_raw(2 * pixels, sizeof *ladder->chosen, error);
    ladder->places = memory_raw(pixels, sizeof *ladder->places, error);
    ladder->strata = memory_raw(pixels, sizeof *ladder->strata, error);
    ladder->blocks = memory_zeroed(blocks, sizeof *ladder->blocks, error);
    return ladder->answers != NULL && ladder->requests != NULL && ladder->chosen != NULL &&
           ladder->places != NULL && ladder->strata != NULL && ladder->blocks != NULL;
}

bool ladder_open(Ladder *ladder, const RefineSetup *setup, Error *error)
{
    Renderer *renderer = setup->renderer;
    Framebuffer *picture = setup->picture;
    *ladder = (Ladder){.setup = *setup,
                       .frame = renderer_frame(renderer, setup->camera),
                       .statistics.pixels = (size_t)picture->width * picture->height};
    ladder->frame.samples = LADDER_GRID;
    if (ladder->frame.max_level > 1)
        ladder->statistics.reflectivity = (double)renderer->scene->reflectivity;
    renderer->progress = (RenderProgress){0};
    if (picture->width > LADDER_SIDE_MOST || picture->height > LADDER_SIDE_MOST ||
        ladder->statistics.pixels > LADDER_PIXELS_MOST)
        return error_set(error, "a picture of %u x %u pixels is too large to be refined",
                         picture->width, picture->height);
    const bool ok =
        make_arrays(ladder, error) &&
        sampler_draw_centers(renderer, &ladder->frame, picture->pixels, setup->observer, error) &&
        ladder_enter(ladder, error);
    ladder->samples = ladder->statistics.pixels;
    if (!ok)
        ladder_close(ladder);
    return ok;
}

void ladder_close(Ladder *ladder)
{
    free(ladder->answers);
    free(ladder->requests);
    free(ladder->chosen);
    free(ladder->places);
    free(ladder->strata);
    free(ladder->blocks);
    free(ladder->sums.data);
    *ladder = (Ladder){0};
}

// The samples that advance a pixel by one rung.
typedef struct {
    uint32_t first;   // number of the first one in the pixel's sequence
    uint32_t samples; // per request
    uint32_t requests;
} RungSamples;

// Returns the samples that advance a pixel from `rung`.
static RungSamples samples_from(uint32_t rung)
{
    const uint32_t first = rung == 0 ? 0 : ladder_samples[rung];
    const uint32_t samples = ladder_is_small(rung) ? SMALL_SAMPLES : LARGE_SAMPLES;
    return (RungSamples){first, samples, (ladder_samples[rung + 1] - first) / samples};
}

static void list_pixel(Ladder *ladder, uint32_t pixel)
{
    const uint32_t width = ladder->setup.picture->width;
    const RungSamples next = samples_from(rung_of(ladder, pixel));
    for (uint32_t i = 0; i < next.requests; i++)
        ladder->requests[ladder->listed++] =
            (PixelRequest){pixel % width, pixel / width, next.first + i * next.samples};
    if (next.samples == SMALL_SAMPLES)
        ladder->small = ladder->listed;
}

static double mean_square_change(const float before[3], const float after[3])
{
    double sum = 0;
    for (int channel = 0; channel < 3; channel++) {
        const double change = (double)after[channel] - (double)before[channel];
        sum += change * change;
    }
    return sum / 3;
}

// Returns the sums of a pixel, or NULL if memory runs out. If the pixel is on rung 0, allocates
// its sums.
static PixelSums *sums_of(Ladder *ladder, uint32_t pixel, Error *error)
{
    LadderPlace *place = &ladder->places[pixel];
    if (rung_of(ladder, pixel) == 0) {
        if (!array_push(&ladder->sums, (PixelSums){0}, error))
            return NULL;
        place->sums = (uint32_t)ladder->sums.count - 1;
    }
    return &ladder->sums.data[place->sums];
}

static double feature_of(const Ladder *ladder, uint32_t pixel)
{
    const LadderPlace *place = &ladder->places[pixel];
    const uint32_t rung = rung_of(ladder, pixel), samples = ladder_samples[rung];
    return rung == 0 ? (double)(place->bend * place->bend)
                     : pixel_sums_variance(&ladder->sums.data[place->sums], samples) / samples;
}

// Advances the pixel by one rung. `first` is the index of the pixel's first request.
static bool climb(Ladder *ladder, uint32_t pixel, uint32_t first, Error *error)
{
    const PixelSums *answers = &ladder->answers[first];
    const PixelRequest *request = &ladder->requests[first];
    const uint32_t stratum = ladder->strata[pixel], rung = strata_rung(stratum);
    const uint32_t samples = ladder_samples[rung + 1];
    const double feature = feature_of(ladder, pixel);
    float *color = ladder->setup.picture->pixels[pixel], before[3];
    PixelSums *sums = sums_of(ladder, pixel, error);
    if (sums == NULL)
        return false;
    for (uint32_t i = 0; i < samples_from(rung).requests; i++)
        pixel_sums_add(sums, &answers[i]);
    memcpy(before, color, sizeof before);
    pixel_sums_mean(sums, samples, color);
    strata_advance(&ladder->statistics, stratum, feature, mean_square_change(before, color));
    const double variance = pixel_sums_variance(sums, samples);
    const BentClass bent = strata_bent_class(stratum, sqrt(feature));
    const uint32_t next = strata_of_deviation(rung + 1, sqrt(variance), bent);
    ladder->strata[pixel] = (uint8_t)next;
    *ladder_block(ladder, request->x, request->y) |= ladder_stratum_bit(next);
    strata_enter(&ladder->statistics, next, 1, variance / samples);
    return true;
}

// The number of pixels that climb_all prefetches ahead.
#define PREFETCHED 8

// Loads a pixel's memory into the cache. Without prefetching, climb() would spend half of its time
// on cache misses.
static void prefetch_pixel(const Ladder *ladder, uint32_t pixel)
{
    __builtin_prefetch(ladder->setup.picture->pixels[pixel], 1);
    __builtin_prefetch(&ladder->places[pixel], 1);
    __builtin_prefetch(&ladder->strata[pixel], 1);
}

// Traces the requests of the listed pixels, advances the pixels, and empties the list.
static bool climb_all(Ladder *ladder, const uint32_t *pixels, size_t count, Error *error)
{
    const SampleList list = {ladder->requests, ladder->answers, ladder->listed, ladder->small};
    uint32_t first = 0;
    bool ok =
        sampler_trace(ladder->setup.renderer, &ladder->frame, &list, ladder->setup.observer, error);
    for (size_t i = 0; i < count && ok && sampler_is_whole(ladder->setup.renderer); i++) {
        const RungSamples next = samples_from(rung_of(ladder, pixels[i]));
        if (i + PREFETCHED < count)
            prefetch_pixel(ladder, pixels[i + PREFETCHED]);
        ok = climb(ladder, pixels[i], first, error);
        first += next.requests;
        ladder->samples += next.requests * next.samples;
    }
    ladder->listed = ladder->small = 0;
    return ok;
}

// Moves the selected pixels up by one rung. If the observer stops the trace, some of them do not
// move.
static bool climb_chosen(Ladder *ladder, uint64_t count, Error *error)
{
    const uint32_t most = samples_from(LADDER_RUNGS - 2).requests;
    const uint32_t *first = ladder->chosen;
    bool ok = true;
    for (uint64_t i = 0; ok && i < count && sampler_is_whole(ladder->setup.renderer); i++) {
        const uint32_t *next = &ladder->chosen[i + 1];
        list_pixel(ladder, ladder->chosen[i]);
        if (i + 1 == count || ladder->listed + most > REQUESTS_MOST) {
            ok = climb_all(ladder, first, (size_t)(next - first), error);
            first = next;
        }
    }
    return ok;
}

// After this many rounds, clrt gives up the goal.
#define ROUNDS_MOST 300

// A round should take at most the fraction PART_OF_ROUND of the remaining time. If less than
// PART_OF_LAST of the budget remains, a round may take all of the remaining time. If less than
// PART_UNSPENT of the budget remains, no further round starts.
#define PART_OF_ROUND 0.5
#define PART_OF_LAST  0.2
#define PART_UNSPENT  0.03

// With a time budget, a round aims at this fraction of the current bound of the mean square error.
#define FALL_OF_ROUND 0.25

// Returns the aim of the next round. With a time budget, limits the round's samples by the speed of
// the previous round.
static StrataAim next_aim(const Ladder *ladder, const Goal *goal, double seconds_per_sample)
{
    const double left = goal->seconds - (clock_seconds() - goal->start);
    const double part = left < PART_OF_LAST * goal->seconds ? 1 : PART_OF_ROUND;
    if (goal->seconds <= 0)
        return (StrataAim){goal->error * goal->error, INFINITY};
    return (StrataAim){FALL_OF_ROUND * strata_estimate(&ladder->statistics).bound,
                       left < PART_UNSPENT * goal->seconds ? 0 : part * left / seconds_per_sample};
}

bool ladder_refine(Ladder *ladder, const Goal *goal, GoalOutcome *outcome, Error *error)
{
    double moment = clock_seconds();
    double seconds_per_sample = (moment - goal->start) / (double)ladder->samples;
    const bool is_early = moment - goal->start < goal->seconds;
    StrataOutcome raised = STRATA_RAISED;
    uint64_t advanced = 1;
    bool ok = true;
    for (int round = 0; ok && round < ROUNDS_MOST && sampler_is_whole(ladder->setup.renderer);
         round++) {
        const StrataAim aim = next_aim(ladder, goal, seconds_per_sample);
        const uint64_t before = ladder->samples;
        if (aim.samples < ladder_samples[1])
            break;
        raised = strata_raise(&ladder->statistics, &aim);
        if (raised == STRATA_REACHED || (raised == STRATA_EXHAUSTED && advanced == 0))
            break;
        ok = ladder_choose(ladder, &advanced, error) && climb_chosen(ladder, advanced, error);
        const double now = clock_seconds();
        if (ladder->samples > before)
            seconds_per_sample = (now - moment) / (double)(ladder->samples - before);
        moment = now;
    }
    const StrataEstimate estimate = strata_estimate(&ladder->statistics);
    *outcome = (GoalOutcome){sqrt(estimate.mean), sqrt(estimate.bound),
                             goal->seconds > 0 ? is_early : raised == STRATA_REACHED};
    return ok;
}
