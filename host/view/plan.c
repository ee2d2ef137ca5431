// SPDX-License-Identifier: MIT
// A frame also has to be shown, and its time varies; so tracing gets a part of it.
#include "view/plan.h"

#define TRACE_SECONDS (PLAN_FRAME_SECONDS * 0.6)

// Two tiles are in flight when a picture is stopped.
#define TILE_SECONDS  0.012
#define TILE_LARGEST  128
#define TILE_SMALLEST 8

#define SAMPLE_GUESS   4e-7
#define TRIANGLE_GUESS 1e-9

static uint32_t divided(uint32_t length, uint32_t divisor)
{
    return (length + divisor - 1) / divisor;
}

static double pixel_count(const PlanWish *wish, uint32_t divisor)
{
    return (double)divided(wish->width, divisor) * divided(wish->height, divisor);
}

// The least divisor that keeps to the time.
static uint32_t moving_divisor(const PlanWish *wish)
{
    static const uint32_t divisors[] = {1, 2, 3, 4, 6, 8, 12, 16};
    const int count = sizeof divisors / sizeof divisors[0];
    int place = 0;
    while (place < count - 1 &&
           pixel_count(wish, divisors[place]) * wish->sample_seconds > TRACE_SECONDS)
        place++;
    return divisors[place];
}

static uint32_t tile_side(double pixel_seconds)
{
    uint32_t side = TILE_LARGEST;
    while (side > TILE_SMALLEST && side * side * pixel_seconds > TILE_SECONDS)
        side /= 2;
    return side;
}

static Pass make_pass(const PlanWish *wish, PassKind kind, uint32_t divisor, uint32_t samples)
{
    return (Pass){.kind = kind,
                  .divisor = divisor,
                  .samples = samples,
                  .width = divided(wish->width, divisor),
                  .height = divided(wish->height, divisor),
                  .tile = tile_side(wish->sample_seconds * samples * samples)};
}

Pass plan_pass(const PlanWish *wish, const PlanReached *reached)
{
    if (!wish->is_wanted || wish->width == 0 || wish->height == 0)
        return (Pass){0};
    if (reached->subject != wish->subject)
        return make_pass(wish, PASS_MOVING, moving_divisor(wish), 1);
    if (reached->divisor > 1)
        return make_pass(wish, PASS_FULL, 1, 1);
    if (reached->samples != wish->samples)
        return make_pass(wish, PASS_FULL, 1, wish->samples);
    if (!reached->is_counted)
        return make_pass(wish, PASS_COUNT, 1, wish->samples);
    return (Pass){0};
}

double plan_first_guess(uint32_t triangles, bool uses_bvh)
{
    return SAMPLE_GUESS + (uses_bvh ? 0 : TRIANGLE_GUESS * triangles);
}
