// SPDX-License-Identifier: MIT
// Chooses the next pass. The measured time per sample determines the sizes of pictures and tiles.
// Tracing may take only part of a frame's time, because displaying takes time too and tracing times
// vary.
#include "view/plan.h"

#include "session/costs.h"

#define TRACE_SECONDS (PLAN_FRAME_SECONDS * 0.6)

// The intended tracing time of a tile in seconds. It is short, because a stopped picture still
// finishes the three tiles in flight.
#define TILE_SECONDS  0.008
#define TILE_LARGEST  128
#define TILE_SMALLEST 8

static uint32_t divided(uint32_t length, uint32_t divisor)
{
    return (length + divisor - 1) / divisor;
}

static double pixel_count(const PlanRequest *request, uint32_t divisor)
{
    return (double)divided(request->full.width, divisor) * divided(request->full.height, divisor);
}

// Returns the smallest divisor with which tracing takes at most TRACE_SECONDS, or the largest
// divisor if tracing always takes longer.
static uint32_t moving_divisor(const PlanRequest *request)
{
    static const uint32_t divisors[] = {1, 2, 3, 4, 6, 8, 12, 16};
    const int count = sizeof divisors / sizeof divisors[0];
    int place = 0;
    while (place < count - 1 &&
           pixel_count(request, divisors[place]) * request->sample_seconds > TRACE_SECONDS)
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

static Pass make_pass(const PlanRequest *request, PassKind kind, uint32_t divisor, uint32_t samples)
{
    Pass pass = {.kind = kind, .divisor = divisor, .settings = request->full};
    pass.settings.width = divided(request->full.width, divisor);
    pass.settings.height = divided(request->full.height, divisor);
    pass.settings.samples = samples;
    pass.settings.tile_width = pass.settings.tile_height =
        tile_side(request->sample_seconds * samples * samples);
    return pass;
}

Pass plan_pass(const PlanRequest *request, const PlanReached *reached)
{
    const RenderSettings *full = &request->full;
    if (!request->is_wanted || full->width == 0 || full->height == 0)
        return (Pass){0};
    if (reached->subject != request->subject)
        return make_pass(request, PASS_MOVING, moving_divisor(request), 1);
    if (reached->divisor > 1)
        return make_pass(request, PASS_FULL, 1, 1);
    if (reached->samples != full->samples)
        return make_pass(request, PASS_FULL, 1, full->samples);
    if (!reached->is_counted)
        return make_pass(request, PASS_COUNT, 1, full->samples);
    return (Pass){0};
}

double plan_first_guess(uint32_t triangles, bool uses_bvh)
{
    return SAMPLE_GUESS + (uses_bvh ? 0 : TRIANGLE_GUESS * triangles);
}
