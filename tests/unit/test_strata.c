// SPDX-License-Identifier: MIT
// Tests strata with populations of pixels whose errors are known. Also tests the sums of a pixel's
// samples.
#include "refine/ladder.h"
#include "refine/ladder_strata.h"
#include "unit/cmocka_all.h"
#include "unit/random.h"

#include <math.h>

#define PIXELS      20000
#define POPULATIONS 200
#define ROUNDS_MOST 300

// error is the pixel's squared error on its current rung.
typedef struct {
    uint32_t stratum;
    double feature, error, chance;
} Pixel;

// A pixel's squared error is proportional to its squared bend, except in flat pixels that hide an
// edge. The share of flat pixels that hide an edge differs between populations. Most of these
// pixels are near a large bend.
static void make_population(Pixel pixels[PIXELS], Strata *strata, uint64_t seed)
{
    uint64_t state = seed;
    const double edges = 0.3 * random_unit(&state), hiding = 0.01 * random_unit(&state);
    *strata = (Strata){.pixels = PIXELS};
    for (int i = 0; i < PIXELS; i++) {
        const bool is_edge = random_unit(&state) < edges, is_near = random_unit(&state) < 0.3;
        const bool hides = !is_edge && random_unit(&state) < (is_near ? hiding : 0.1 * hiding);
        const double bend =
            is_edge ? random_unit(&state) : 0.02 * random_unit(&state) * random_unit(&state);
        const double error = is_edge ? 0.1 * bend : hides ? 0.1 * random_unit(&state) : 0.1 * bend;
        pixels[i] = (Pixel){.stratum = strata_of_bend((float)bend, is_near ? 0.5f : 0, false),
                            .feature = bend * bend,
                            .error = error * error,
                            .chance = random_unit(&state)};
        strata_enter(strata, pixels[i].stratum, 1, pixels[i].feature);
    }
}

// Doubling the samples divides squared errors by 2.83, as at an edge. The first step quadruples the
// samples.
#define DOUBLING (1 / 2.83)

static void advance(Pixel *pixel, Strata *strata, uint64_t *state)
{
    const uint32_t rung = strata_rung(pixel->stratum);
    const double part = rung == 0 ? DOUBLING * DOUBLING : DOUBLING, later = part * pixel->error;
    const double change = rung == 0 ? pixel->error + later : pixel->error - later;
    strata_advance(strata, pixel->stratum, pixel->feature, change);
    pixel->error = later;
    pixel->stratum = strata_of_deviation(rung + 1, sqrt(pixel->feature), BENT_LITTLE);
    pixel->feature *= part;
    pixel->chance = random_unit(state);
    strata_enter(strata, pixel->stratum, 1, pixel->feature);
}

static double mean_error(const Pixel pixels[PIXELS])
{
    double sum = 0;
    for (int i = 0; i < PIXELS; i++)
        sum += pixels[i].error;
    return sum / PIXELS;
}

// Advances pixels until their mean squared error is small enough. Returns whether this succeeds.
static bool reach(Pixel pixels[PIXELS], Strata *strata, double mean_square, uint64_t seed)
{
    const StrataAim aim = {.mean_square = mean_square, .samples = INFINITY};
    uint64_t state = seed;
    for (int round = 0; round < ROUNDS_MOST; round++) {
        const StrataOutcome outcome = strata_raise(strata, &aim);
        if (outcome != STRATA_RAISED)
            return outcome == STRATA_REACHED;
        for (int i = 0; i < PIXELS; i++)
            if (pixels[i].chance < strata->strata[pixels[i].stratum].fraction)
                advance(&pixels[i], strata, &state);
    }
    return false;
}

TEST(the_bound_exceeds_the_error_of_19_populations_in_20)
{
    static Pixel pixels[PIXELS];
    int exceeded = 0;
    for (uint64_t seed = 1; seed <= POPULATIONS; seed++) {
        Strata strata;
        make_population(pixels, &strata, seed);
        const double before = mean_error(pixels);
        assert_true(reach(pixels, &strata, before / 20, seed));
        const StrataEstimate estimate = strata_estimate(&strata);
        assert_true(estimate.mean < estimate.bound && estimate.bound <= before / 20);
        exceeded += mean_error(pixels) > estimate.bound;
    }
    print_message("%d of %d errors exceed their bounds\n", exceeded, POPULATIONS);
    assert_true(20 * exceeded <= POPULATIONS);
}

TEST(flat_strata_get_controls_for_any_aim)
{
    const StrataAim aim = {.mean_square = 1, .samples = INFINITY};
    Strata strata = {.pixels = PIXELS};
    const uint32_t flat = strata_of_bend(0, 0, false), near = strata_of_bend(0, 1, false);
    for (int i = 0; i < PIXELS; i++)
        strata_enter(&strata, i % 2 ? flat : near, 1, 0);
    assert_int_not_equal(flat, near);
    assert_int_equal(strata_raise(&strata, &aim), STRATA_RAISED);
    assert_true(strata.strata[flat].fraction >= 24.0 / PIXELS);
    assert_true(strata.strata[near].fraction >= 24.0 / PIXELS);
    assert_int_equal(strata_raise(&strata, &aim), STRATA_REACHED);
}

// Returns the estimate for a picture of flat pixels, which are all on one rung.
static double flat_estimate(uint32_t rung, double reflectivity)
{
    Strata strata = {.pixels = PIXELS, .reflectivity = reflectivity};
    strata_enter(&strata,
                 rung == 0 ? strata_of_bend(0, 0, false)
                           : strata_of_deviation(rung, 0, BENT_LITTLE),
                 PIXELS, 0);
    return strata_estimate(&strata).mean;
}

TEST(only_strong_mirrors_raise_the_prior_of_flat_pixels)
{
    for (uint32_t rung = 0; rung < 3; rung++) {
        assert_true(flat_estimate(rung, 0.5) == flat_estimate(rung, 0));
        assert_true(flat_estimate(rung, 0.8) > flat_estimate(rung, 0));
        assert_true(flat_estimate(rung, 1) > flat_estimate(rung, 0.8));
    }
}

TEST(pixels_on_the_last_rung_exhaust_the_ladder)
{
    const StrataAim aim = {.mean_square = 1e-12, .samples = INFINITY};
    Strata strata = {.pixels = 10};
    for (int i = 0; i < 10; i++)
        strata_enter(&strata, strata_of_deviation(LADDER_RUNGS - 1, 0.4, BENT_SOME), 1, 1e-4);
    assert_int_equal(strata_raise(&strata, &aim), STRATA_EXHAUSTED);
}

// Returns the estimate for a picture of flat pixels and one uneven pixel, all on one rung.
static double estimate_on(uint32_t rung)
{
    Strata strata = {.pixels = PIXELS};
    for (int i = 0; i < PIXELS; i++) {
        const double deviation = i == 0 ? 0.4 : 0;
        strata_enter(&strata, strata_of_deviation(rung, deviation, BENT_LITTLE), 1,
                     deviation * deviation / ladder_samples[rung]);
    }
    return strata_estimate(&strata).mean;
}

TEST(no_bound_of_pixels_without_contrast_is_0)
{
    const uint32_t last = LADDER_RUNGS - 1;
    for (uint32_t rung = 0; rung <= last; rung++) {
        Strata strata = {.pixels = PIXELS};
        const uint32_t stratum =
            rung == 0 ? strata_of_bend(0, 0, false) : strata_of_deviation(rung, 0, BENT_LITTLE);
        strata_enter(&strata, stratum, PIXELS, 0);
        for (int i = 0; i < PIXELS / 2 && rung < last; i++)
            strata_advance(&strata, stratum, 0, 0);
        assert_true(strata_estimate(&strata).mean > 0);
    }
}

TEST(thin_parts_form_a_stratum_unless_there_is_contrast)
{
    const uint32_t thin = strata_of_bend(0, 0, true);
    assert_int_not_equal(thin, strata_of_bend(0, 0, false));
    assert_int_equal(thin, strata_of_bend(0, 1, true));
    assert_int_equal(strata_of_bend(0.7f, 1, true), strata_of_bend(0.7f, 1, false));
    assert_int_equal(strata_bent_class(thin, 0), BENT_SOME);
}

TEST(pixels_keep_the_class_of_their_bend)
{
    static const double bends[BENT_CLASSES] = {0, 0.25, 0.75};
    for (BentClass bent = 0; bent < BENT_CLASSES; bent++) {
        const uint32_t stratum = strata_of_bend((float)bends[bent], 1, false);
        assert_int_equal(strata_bent_class(stratum, bends[bent]), bent);
        for (uint32_t rung = 1; rung < LADDER_RUNGS; rung++) {
            const uint32_t higher = strata_of_deviation(rung, 0.1, bent);
            assert_int_equal(strata_rung(higher), rung);
            assert_int_equal(strata_bent_class(higher, 0), bent);
        }
    }
}

// Returns the outcome for pixels of one stratum without controls.
static StrataOutcome raise_unknown(double mean_square, StrataEstimate *estimate)
{
    Strata strata = {.pixels = PIXELS};
    const StrataAim aim = {mean_square, INFINITY};
    strata_enter(&strata, strata_of_deviation(1, 0.4, BENT_LITTLE), PIXELS, 0.04 * PIXELS);
    *estimate = strata_estimate(&strata);
    return strata_raise(&strata, &aim);
}

TEST(strata_need_no_controls_if_twice_their_error_meets_the_aim)
{
    StrataEstimate estimate;
    raise_unknown(1, &estimate);
    const double once = estimate.bound, twice = estimate.bound + estimate.mean;
    assert_int_equal(raise_unknown(1.01 * twice, &estimate), STRATA_REACHED);
    assert_int_equal(raise_unknown(0.99 * twice, &estimate), STRATA_RAISED);
    assert_int_equal(raise_unknown(1.01 * once, &estimate), STRATA_RAISED);
}

// More samples of a flat pixel leave less room for hidden detail.
TEST(doubled_samples_of_flat_pixels_have_a_quarter_of_the_error)
{
    for (uint32_t rung = 1; rung + 1 < LADDER_RUNGS; rung++)
        assert_true(estimate_on(rung + 1) < 0.25 * estimate_on(rung));
}

TEST(no_more_samples_are_planned_than_may_be_taken)
{
    static Pixel pixels[PIXELS];
    Strata strata;
    make_population(pixels, &strata, 1);
    assert_int_equal(strata_raise(&strata, &(StrataAim){1e-12, INFINITY}), STRATA_RAISED);
    double before[STRATA_COUNT], planned = 0;
    for (uint32_t i = 0; i < STRATA_COUNT; i++)
        before[i] = strata.strata[i].fraction;
    assert_int_equal(strata_raise(&strata, &(StrataAim){1e-12, 1600}), STRATA_RAISED);
    for (uint32_t i = 0; i < STRATA_COUNT; i++)
        planned += 4 * (strata.strata[i].fraction - before[i]) * (double)strata.strata[i].entered;
    assert_true(planned > 0 && planned < 2 * 1600);
}

TEST(sums_give_mean_and_variance)
{
    PixelSums sums = {.squares = 0};
    // Eight of the 16 samples are black, and eight are (1, 0.5, 0).
    const PixelSums bright = {{1ull << 32, 1ull << 31, 0}, (1ull << 48) + (1ull << 46)};
    for (int i = 0; i < 8; i++)
        pixel_sums_add(&sums, &bright);
    float mean[3];
    pixel_sums_mean(&sums, 16, mean);
    assert_true(mean[0] == 0.5f && mean[1] == 0.25f && mean[2] == 0.0f);
    assert_true(pixel_sums_variance(&sums, 16) == (0.25 + 0.0625) / 3);
}
