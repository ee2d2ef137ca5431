// SPDX-License-Identifier: MIT
// Each call of ladder_advance lists the selected pixels in picture order, traces their samples, and
// records their changes in the same order. Floating-point sums therefore do not depend on threads.
#include "refine/ladder.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

// Seeds of a pixel's hashes: SCRAMBLE_SEED for its samples, RUNG_SEED + rung for its selection on a
// rung.
#define SCRAMBLE_SEED 0
#define RUNG_SEED     1

// Samples of a request for the first REQUEST_SAMPLES samples of a pixel. Later requests have
// REQUEST_SAMPLES samples.
#define FIRST_SAMPLES 4

static uint64_t hash_of(uint32_t pixel, uint64_t seed)
{
    return XXH3_64bits_withSeed(&pixel, sizeof pixel, seed);
}

static uint32_t rung_of(const Ladder *ladder, size_t pixel)
{
    return strata_rung(ladder->strata[pixel]);
}

uint32_t ladder_pixel_samples(const Ladder *ladder, size_t pixel)
{
    const uint32_t rung = rung_of(ladder, pixel);
    return rung == 0 ? 1 : 1 + ladder_samples[rung];
}

static void enter(Ladder *ladder, size_t pixel, uint32_t stratum, double feature)
{
    ladder->strata[pixel] = (uint8_t)stratum;
    ladder->features[pixel] = (float)feature;
    strata_enter(&ladder->statistics, stratum, (double)ladder->features[pixel]);
}

// Assigns all pixels to strata of rung 0 by the samples at their centers.
static bool enter_all(Ladder *ladder, Error *error)
{
    const size_t pixels = ladder->statistics.pixels;
    float *nearby = memory_raw(pixels, sizeof *nearby, error);
    if (nearby == NULL)
        return false;
    bends_measure(ladder->picture, ladder->requests.pool, ladder->features);
    bends_spread(ladder->picture, ladder->requests.pool, ladder->features, nearby);
    for (size_t pixel = 0; pixel < pixels; pixel++) {
        const double bend = (double)ladder->features[pixel];
        enter(ladder, pixel, strata_of_bend(bend, (double)nearby[pixel]), bend * bend);
    }
    free(nearby);
    return true;
}

static bool make_arrays(Ladder *ladder, Error *error)
{
    const size_t pixels = ladder->statistics.pixels;
    ladder->features = memory_raw(pixels, sizeof *ladder->features, error);
    ladder->strata = memory_raw(pixels, sizeof *ladder->strata, error);
    ladder->sum_places = memory_zeroed(pixels, sizeof *ladder->sum_places, error);
    return ladder->features != NULL && ladder->strata != NULL && ladder->sum_places != NULL &&
           array_push(&ladder->sums, (PixelSums){0}, error) &&
           pixel_requests_make(&ladder->requests, error);
}

bool ladder_open(Ladder *ladder, const LadderSetup *setup, Error *error)
{
    Renderer *renderer = setup->renderer;
    Framebuffer *picture = setup->picture;
    PixelRequests *requests = &ladder->requests;
    *ladder = (Ladder){.requests = {.renderer = renderer,
                                    .frame = renderer->frame,
                                    .observer = setup->observer,
                                    .pool = setup->pool},
                       .picture = picture,
                       .statistics.pixels = (size_t)picture->width * picture->height};
    requests->frame.camera = *setup->camera;
    requests->frame.samples = LADDER_GRID;
    renderer->progress = (RenderProgress){0};
    if (picture->width > LADDER_SIDE_MOST || picture->height > LADDER_SIDE_MOST ||
        ladder->statistics.pixels > LADDER_PIXELS_MOST)
        return error_set(error, "a picture of %u x %u pixels is too large to be refined",
                         picture->width, picture->height);
    const bool ok = make_arrays(ladder, error) &&
                    pixel_requests_draw_centers(requests, picture, error) &&
                    enter_all(ladder, error);
    ladder->samples = ladder->statistics.pixels;
    if (!ok)
        ladder_close(ladder);
    return ok;
}

void ladder_close(Ladder *ladder)
{
    pixel_requests_free(&ladder->requests);
    free(ladder->features);
    free(ladder->strata);
    free(ladder->sum_places);
    free(ladder->sums.data);
    *ladder = (Ladder){0};
}

// The samples that advance a pixel by one rung.
typedef struct {
    uint32_t first;   // index of its first sample
    uint32_t samples; // of a request
    uint32_t requests;
} Step;

static Step step_from(uint32_t rung)
{
    const uint32_t first = rung == 0 ? 0 : ladder_samples[rung];
    const uint32_t samples = first < REQUEST_SAMPLES ? FIRST_SAMPLES : REQUEST_SAMPLES;
    return (Step){first, samples, (ladder_samples[rung + 1] - first) / samples};
}

static void list_pixel(Ladder *ladder, uint32_t pixel)
{
    PixelRequests *requests = &ladder->requests;
    const uint32_t width = ladder->picture->width;
    const uint32_t place[2] = {pixel % width, pixel / width};
    const uint64_t hash = hash_of(pixel, SCRAMBLE_SEED);
    const Step step = step_from(rung_of(ladder, pixel));
    for (uint32_t i = 0; i < step.requests; i++)
        requests->requests[requests->count++] =
            pixel_request(place, step.first + i * step.samples, step.samples, hash);
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

// Returns the sums of a pixel, or NULL if memory is exhausted. If the pixel is on rung 0, allocates
// its sums.
static PixelSums *sums_of(Ladder *ladder, uint32_t pixel, Error *error)
{
    if (ladder->sum_places[pixel] == 0) {
        if (!array_push(&ladder->sums, (PixelSums){0}, error))
            return NULL;
        ladder->sum_places[pixel] = (uint32_t)ladder->sums.count - 1;
    }
    return &ladder->sums.data[ladder->sum_places[pixel]];
}

// Advances the pixel by one rung. answers are the sums of its requests.
static bool climb(Ladder *ladder, uint32_t pixel, const PixelSums *answers, Error *error)
{
    const uint32_t stratum = ladder->strata[pixel], rung = strata_rung(stratum);
    const uint32_t samples = ladder_samples[rung + 1];
    const double feature = (double)ladder->features[pixel];
    float *color = ladder->picture->pixels[pixel], before[3];
    PixelSums *sums = sums_of(ladder, pixel, error);
    if (sums == NULL)
        return false;
    for (uint32_t i = 0; i < step_from(rung).requests; i++)
        pixel_sums_add(sums, &answers[i]);
    memcpy(before, color, sizeof before);
    pixel_sums_mean(sums, samples, color);
    strata_advance(&ladder->statistics, stratum, feature, mean_square_change(before, color));
    const double variance = pixel_sums_variance(sums, samples);
    const bool is_bent = strata_is_bent(stratum, sqrt(feature));
    enter(ladder, pixel, strata_of_deviation(rung + 1, sqrt(variance), is_bent),
          variance / samples);
    return true;
}

// Traces the requests of the listed pixels, advances the pixels, and empties the list.
static bool climb_all(Ladder *ladder, const uint32_t *pixels, size_t count, Error *error)
{
    PixelRequests *requests = &ladder->requests;
    const PixelSums *answers = requests->sums;
    bool ok = pixel_requests_trace(requests, error);
    for (size_t i = 0; i < count && ok && pixel_requests_are_whole(requests); i++) {
        const Step step = step_from(rung_of(ladder, pixels[i]));
        ok = climb(ladder, pixels[i], answers, error);
        answers += step.requests;
        ladder->samples += step.requests * step.samples;
    }
    requests->count = 0;
    return ok;
}

static bool climb_chosen(Ladder *ladder, const uint32_t *pixels, uint64_t count, Error *error)
{
    const uint32_t most = step_from(LADDER_RUNGS - 2).requests;
    size_t listed = 0;
    for (uint64_t i = 0; i < count; i++) {
        list_pixel(ladder, pixels[i]);
        listed++;
        if (i + 1 < count && ladder->requests.count + most <= REQUESTS_MOST)
            continue;
        if (!climb_all(ladder, &pixels[i + 1 - listed], listed, error))
            return false;
        if (!pixel_requests_are_whole(&ladder->requests))
            return true;
        listed = 0;
    }
    return true;
}

// The side of a block of pixels. Selected pixels are listed block by block, because rays of nearby
// pixels traverse the tree together. Listed row by row, pictures took 3 to 10 % longer.
#define CHOICE_SIDE 8

// Selects the pixels that advance, in rows of blocks.
typedef struct {
    const Ladder *ladder;
    double fractions[STRATA_COUNT]; // 0 if no further pixel is to be selected
    uint32_t *pixels; // the selected pixels; those of a row start at the index of its first pixel
    uint32_t *counts; // the number of selected pixels of each row of blocks
} Choosing;

// Returns a number in [0, 1) that is constant while the pixel stays on its rung.
static double chance_of(const Ladder *ladder, uint32_t pixel)
{
    return (double)(hash_of(pixel, RUNG_SEED + rung_of(ladder, pixel)) >> 11) * 0x1p-53;
}

// Copies the fractions of the strata whose requests have `samples` samples. If a stratum's fraction
// and pixels have not changed, it has no new pixel to select. Skipping it avoids most hashes.
static void take_fractions(Choosing *choosing, Ladder *ladder, uint32_t samples)
{
    for (uint32_t i = 0; i < STRATA_COUNT; i++) {
        const uint32_t rung = strata_rung(i);
        if (rung + 1 == LADDER_RUNGS || step_from(rung).samples != samples)
            continue;
        const Stratum *now = &ladder->statistics.strata[i];
        Stratum *before = &ladder->chosen.strata[i];
        const bool is_same = now->fraction == before->fraction && now->entered == before->entered;
        choosing->fractions[i] = is_same ? 0 : now->fraction;
        *before = *now;
    }
}

static uint32_t *choose_block(const Choosing *choosing, uint32_t left, uint32_t top,
                              uint32_t *chosen)
{
    const Ladder *ladder = choosing->ladder;
    const uint32_t width = ladder->picture->width, height = ladder->picture->height;
    for (uint32_t y = top; y < top + CHOICE_SIDE && y < height; y++)
        for (uint32_t x = left; x < left + CHOICE_SIDE && x < width; x++) {
            const uint32_t pixel = y * width + x;
            const double fraction = choosing->fractions[ladder->strata[pixel]];
            if (fraction > 0 && chance_of(ladder, pixel) < fraction)
                *chosen++ = pixel;
        }
    return chosen;
}

static void choose_rows(void *context, uint32_t first, uint32_t end)
{
    const Choosing *choosing = context;
    const uint32_t width = choosing->ladder->picture->width;
    for (uint32_t row = first; row < end; row++) {
        uint32_t *start = choosing->pixels + (size_t)row * CHOICE_SIDE * width, *chosen = start;
        for (uint32_t left = 0; left < width; left += CHOICE_SIDE)
            chosen = choose_block(choosing, left, row * CHOICE_SIDE, chosen);
        choosing->counts[row] = (uint32_t)(chosen - start);
    }
}

// Moves the selected pixels of all rows to the start of the array, and returns their number.
static uint64_t join_rows(const Choosing *choosing, uint32_t rows)
{
    const size_t row_pixels = (size_t)CHOICE_SIDE * choosing->ladder->picture->width;
    uint64_t count = 0;
    for (uint32_t row = 0; row < rows; row++) {
        memmove(choosing->pixels + count, choosing->pixels + row * row_pixels,
                choosing->counts[row] * sizeof *choosing->pixels);
        count += choosing->counts[row];
    }
    return count;
}

// Advances the selected pixels whose requests have `samples` samples. Adds their number to
// *advanced.
static bool advance_alike(Ladder *ladder, uint32_t samples, uint64_t *advanced, Error *error)
{
    const size_t pixels = ladder->statistics.pixels;
    const uint32_t rows = range_count(ladder->picture->height, CHOICE_SIDE);
    Choosing choosing = {.ladder = ladder,
                         .pixels = memory_raw(pixels, sizeof *choosing.pixels, error),
                         .counts = memory_raw(rows, sizeof *choosing.counts, error)};
    bool ok = choosing.pixels != NULL && choosing.counts != NULL;
    if (ok) {
        take_fractions(&choosing, ladder, samples);
        thread_pool_share(ladder->requests.pool, rows, 1, choose_rows, &choosing);
        const uint64_t count = join_rows(&choosing, rows);
        ok = climb_chosen(ladder, choosing.pixels, count, error);
        *advanced += count;
    }
    free(choosing.pixels);
    free(choosing.counts);
    return ok;
}

bool ladder_advance(Ladder *ladder, uint64_t *advanced, Error *error)
{
    *advanced = 0;
    return advance_alike(ladder, FIRST_SAMPLES, advanced, error) &&
           (!pixel_requests_are_whole(&ladder->requests) ||
            advance_alike(ladder, REQUEST_SAMPLES, advanced, error));
}
