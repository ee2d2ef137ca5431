// SPDX-License-Identifier: MIT
// Tests that samples find 95 % of random disks with the diameter that feature_smallest returns.
#include "session/feature.h"
#include "unit/cmocka_all.h"
#include "unit/random.h"

#include <math.h>
#include <stdbool.h>

#define DISKS 200000

// Returns whether a random disk contains a sample, if a pixel has side x side samples. The diameter
// is in pixels.
static bool disk_is_found(double diameter, uint32_t side, uint64_t *state)
{
    const double x = random_unit(state) - 0.5, y = random_unit(state) - 0.5;
    return hypot(x, y) <= diameter * side / 2;
}

// Returns the share of random disks that the samples find. `shares` has the samples of all pixels.
static double found_share(double diameter, const SampleShare *shares, size_t count)
{
    uint64_t state = 1, pixels = 0;
    double found = 0;
    for (size_t i = 0; i < count; i++) {
        const uint32_t side = (uint32_t)lround(sqrt(shares[i].samples));
        uint32_t disks = 0;
        for (int disk = 0; disk < DISKS; disk++)
            disks += disk_is_found(diameter, side, &state);
        found += (double)disks / DISKS * (double)shares[i].pixels;
        pixels += shares[i].pixels;
    }
    return found / (double)pixels;
}

static void expect_95_percent(const SampleShare *shares, size_t count)
{
    const double diameter = feature_smallest(shares, count);
    assert_true(fabs(found_share(diameter, shares, count) - 0.95) < 0.003);
}

TEST(samples_find_95_percent_of_disks_of_the_smallest_size)
{
    expect_95_percent((SampleShare[]){{1, 1}}, 1);
    expect_95_percent((SampleShare[]){{16, 7}}, 1);
    expect_95_percent((SampleShare[]){{1, 1000}, {4, 500}, {64, 300}}, 3);
    expect_95_percent((SampleShare[]){{1, 1}, {16, 99}}, 2);
    expect_95_percent((SampleShare[]){{1, 0}, {4, 5}, {16, 0}}, 3);
}

TEST(the_smallest_size_shrinks_with_the_distance_of_samples)
{
    const double one = feature_smallest((SampleShare[]){{1, 3}}, 1);
    const double five = feature_smallest((SampleShare[]){{25, 3}}, 1);
    assert_true(fabs(one - 5 * five) < 1e-6 && one > 1 && one < sqrt(2));
}
