// SPDX-License-Identifier: MIT
// Compares the fixed sine and cosine with the C library's long double functions.
#include "base/vec.h"

#include "unit/cmocka_all.h"

#include <math.h>

static void multiples_of_ninety_degrees_are_exact(void **state)
{
    (void)state;
    const double sines[4] = {0, 1, 0, -1};
    for (int turn = -8; turn <= 8; turn++) {
        assert_true(sine_of_degrees(90.0 * turn) == sines[turn & 3]);
        assert_true(cosine_of_degrees(90.0 * turn) == sines[(turn + 1) & 3]);
    }
}

// The tolerance of 4 * 2^-53 covers two roundings of the series and one of the angle on each side.
static void all_angles_agree_with_the_library(void **state)
{
    (void)state;
    for (double degrees = -400; degrees <= 400; degrees += 0.37) {
        const long double radians = (long double)degrees * 3.14159265358979323846264338L / 180;
        assert_true(fabs(sine_of_degrees(degrees) - (double)sinl(radians)) < 0x1p-51);
        assert_true(fabs(cosine_of_degrees(degrees) - (double)cosl(radians)) < 0x1p-51);
    }
}

// The series yields an eighth of the angle, so its rounding errors count eightfold.
static void angles_between_vectors_agree_with_the_library(void **state)
{
    (void)state;
    for (double degrees = 0; degrees <= 180; degrees += 0.037) {
        const Vec3 a = {cosine_of_degrees(degrees), sine_of_degrees(degrees), 0};
        const Vec3 x = {1, 0, 0}, away = {-1, 0, 0};
        const double angle = (double)atan2l((long double)a.y, (long double)a.x);
        assert_true(fabs(angle_between(a, x) - angle) < 0x1p-48);
        assert_true(fabs(angle_between(away, a) - (3.14159265358979323846 - angle)) < 0x1p-48);
    }
    assert_true(angle_between(vec3(0, 1, 0), vec3(0, 1, 0)) == 0);
}

// Lengths whose squares overflow or underflow take another path than these.
static void normalized_bits_are_those_of_division_by_a_power_of_two(void **state)
{
    (void)state;
    for (int exponent = -1000; exponent <= 1000; exponent += 10)
        for (int i = 1; i < 100; i++) {
            const Vec3 a = {1.0 / i, 0.37 * i, 1 - 0.011 * i}, expected = vec3_normalize(a);
            const Vec3 scaled = {scalbn(a.x, exponent), scalbn(a.y, exponent),
                                 scalbn(a.z, exponent)};
            const Vec3 normal = vec3_normalize(scaled);
            assert_memory_equal(&normal, &expected, sizeof normal);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(multiples_of_ninety_degrees_are_exact),
        cmocka_unit_test(all_angles_agree_with_the_library),
        cmocka_unit_test(angles_between_vectors_agree_with_the_library),
        cmocka_unit_test(normalized_bits_are_those_of_division_by_a_power_of_two),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
