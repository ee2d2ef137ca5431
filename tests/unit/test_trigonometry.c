// SPDX-License-Identifier: MIT
// Compares the fixed sine and cosine with the C library's long double functions.
#include "base/vec.h"

#include "unit/cmocka_all.h"

#include <math.h>

TEST(multiples_of_ninety_degrees_are_exact)
{
    const double sines[4] = {0, 1, 0, -1};
    for (int turn = -8; turn <= 8; turn++) {
        assert_true(sine_of_degrees(90.0 * turn) == sines[turn & 3]);
        assert_true(cosine_of_degrees(90.0 * turn) == sines[(turn + 1) & 3]);
    }
}

// The tolerance of 4 * 2^-53 covers two roundings of the series and one of the angle on each side.
TEST(all_angles_agree_with_the_library)
{
    for (double degrees = -400; degrees <= 400; degrees += 0.37) {
        const long double radians = (long double)degrees * 3.14159265358979323846264338L / 180;
        assert_true(fabs(sine_of_degrees(degrees) - (double)sinl(radians)) < 0x1p-51);
        assert_true(fabs(cosine_of_degrees(degrees) - (double)cosl(radians)) < 0x1p-51);
    }
}
