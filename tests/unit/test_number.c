// SPDX-License-Identifier: MIT
// Compares base/number with known bit patterns, and with the C library's strtod in the C locale.
// Compares the sines, cosines and angles of base/vec.h with the C library's long double functions.
#include "base/number.h"
#include "base/vec.h"

#include "unit/cmocka_all.h"
#include "unit/random.h"

#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Returns a copy without spare bytes, so that sanitizers detect every access beyond the end.
static char *copy_of(const char *text, size_t size)
{
    char *copy = malloc(size + (size == 0));
    assert_non_null(copy);
    return memcpy(copy, text, size);
}

// Returns the length of the number at the start of the text, or -1 if there is no number.
static int number_length(const char *text, size_t size, double *value)
{
    char *copy = copy_of(text, size);
    const char *stop = number_parse(copy, copy + size, value);
    const int length = stop == NULL ? -1 : (int)(stop - copy);
    free(copy);
    return length;
}

static int integer_length(const char *text, int64_t *value)
{
    const size_t size = strlen(text);
    char *copy = copy_of(text, size);
    const char *stop = integer_parse(copy, copy + size, value);
    const int length = stop == NULL ? -1 : (int)(stop - copy);
    free(copy);
    return length;
}

static void expect_double(const char *text, double expected)
{
    double value = 42;
    if (number_length(text, strlen(text), &value) != (int)strlen(text))
        fail_msg("'%.60s' is not read to its end", text);
    if (memcmp(&value, &expected, sizeof value) != 0)
        fail_msg("'%.60s' gives %a instead of %a", text, value, expected);
}

TEST(every_spelling_of_a_decimal_rounds_as_in_the_c_library)
{
    static const char *const spellings[] = {
        "0",         "-0",     "7",      "-7",           "+7",
        "1.5",       "-.5",    "5.",     "1e3",          "1E+3",
        "2.5e-3",    ".5e1",   "5.e1",   "0.1",          "-0.0e-5",
        "00012.500", "-1e309", "1e-400", "123456789012", "-0.991745102557"};
    for (size_t i = 0; i < sizeof spellings / sizeof *spellings; i++)
        expect_double(spellings[i], strtod(spellings[i], NULL));
}

typedef struct {
    const char *text;
    double value;
} Case;

// Halves, ties and neighbors of powers of two and ten, and exponents beyond all integer types.
static const Case hard_cases[] = {
    {"1e99999999999999999999999", HUGE_VAL},
    {"-1e-99999999999999999999999", -0.0},
    {"0e99999999999999999999999", 0},
    {"9007199254740991", 0x1.fffffffffffffp52},
    {"9007199254740993", 0x1p53},
    {"9007199254740995", 0x1.0000000000002p53},
    {"9007199254740993.0000000000000000000000000001", 0x1.0000000000001p53},
    {"1e22", 1e22},
    {"1e23", 0x1.52d02c7e14af6p76},
    {"8.5e22", 8.5e22},
    {"1.7976931348623157e308", 0x1.fffffffffffffp1023},
    {"1.7976931348623158e308", 0x1.fffffffffffffp1023},
    {"1.7976931348623159e308", HUGE_VAL},
    {"2.2250738585072011e-308", 0x0.fffffffffffffp-1022},
    {"2.2250738585072014e-308", 0x1p-1022},
    {"4.9406564584124654e-324", 0x1p-1074},
    {"2.4703282292062327e-324", 0},
    {"2.4703282292062328e-324", 0x1p-1074},
    {"18446744073709551615", 0x1p64},
    {"18446744073709551616", 0x1p64},
    {"9999999999999999999", 0x1.158e460913dp63},
    {"99999999999999999999", 0x1.5af1d78b58c4p66},
    {"0.000000000000000000000000000001", 1e-30},
    {"9223372036854775807e27", 9223372036854775807e27},
    {"9223372036854775807e28", 9223372036854775807e28},
    {"9999999999999999999e-27", 9999999999999999999e-27},
    {"1e-27", 1e-27},
    // The quotient ends in a tie, which only the remainder of the division breaks.
    {"11692940222490064e-27", 0x1.9b68a4781c555p-37},
    {"20828936362704393e-27", 0x1.6e6d30a690f5dp-36}};

TEST(hard_cases_round_to_the_nearest_double)
{
    for (size_t i = 0; i < sizeof hard_cases / sizeof *hard_cases; i++)
        expect_double(hard_cases[i].text, hard_cases[i].value);
}

TEST(a_number_stops_where_the_grammar_does)
{
    static const char *const texts[][2] = {
        {"1e", "1"},   {"1e+", "1"},    {"1e-x", "1"}, {"1.5.2", "1.5"}, {"1,5", "1"},
        {"0x10", "0"}, {"12abc", "12"}, {"1-2", "1"},  {"3 4", "3"},     {"1e5e5", "1e5"}};
    static const char *const wrong[] = {"",    "-",   "+",   ".",  "-.",   "e5",       ".e5", "inf",
                                        "nan", "INF", "+-1", " 1", "-nan", "nan(0x1)", ",5"};
    double value;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        assert_int_equal(number_length(texts[i][0], strlen(texts[i][0]), &value),
                         strlen(texts[i][1]));
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        assert_int_equal(number_length(wrong[i], strlen(wrong[i]), &value), -1);
}

TEST(no_byte_beyond_the_end_is_read)
{
    static const char text[] = "-12.75e-12";
    for (size_t size = 0; size <= strlen(text); size++) {
        char terminated[sizeof text] = "";
        double value;
        memcpy(terminated, text, size);
        assert_int_equal(number_length(text, size, &value) >= 0, size >= 2);
        assert_true(size < 2 || value == strtod(terminated, NULL));
    }
}

TEST(random_spellings_agree_with_the_c_library)
{
    uint64_t random = 1;
    for (int round = 0; round < 200000; round++) {
        char text[64], spelled[32];
        const int digits = (int)random_below(&random, 20) + 1;
        const int range = round % 2 == 0 ? 46 : 660;
        const int exponent = (int)random_below(&random, (uint32_t)range) - range / 2;
        const int whole = (int)random_below(&random, (uint32_t)digits + 1);
        snprintf(spelled, sizeof spelled, "%020llu", (unsigned long long)random_bits(&random));
        snprintf(text, sizeof text, "%s%.*s.%.*se%d", round % 3 == 0 ? "-" : "", whole, spelled,
                 digits - whole, spelled + whole, exponent);
        expect_double(text, strtod(text, NULL));
    }
}

TEST(a_double_printed_with_17_digits_comes_back)
{
    uint64_t random = 2;
    for (int round = 0; round < 200000; round++) {
        const uint64_t bits = random_bits(&random);
        double value;
        char text[64];
        memcpy(&value, &bits, sizeof value);
        snprintf(text, sizeof text, "%.17g", value);
        if (isfinite(value))
            expect_double(text, value);
    }
}

// Expects this value for the text that consists of head, a million zeros and tail.
static void expect_around_zeros(const char *head, const char *tail, double expected)
{
    const size_t zeros = 1000000, size = strlen(head) + zeros + strlen(tail) + 1;
    char *text = malloc(size);
    assert_non_null(text);
    strcpy(text, head);
    memset(text + strlen(head), '0', zeros);
    strcpy(text + strlen(head) + zeros, tail);
    expect_double(text, expected);
    free(text);
}

TEST(a_token_of_a_megabyte_is_still_rounded_correctly)
{
    expect_around_zeros("0.", "1e1000001", 1);
    expect_around_zeros("1", "e-1000000", 1);
    expect_around_zeros("", "12.5", 12.5);
    expect_around_zeros("1.5", "", 1.5);
    expect_around_zeros("9007199254740993.", "", 0x1p53);
    expect_around_zeros("9007199254740993.", "1", 0x1.0000000000001p53);
    expect_around_zeros("1", "", HUGE_VAL);
}

// (2^53 - 1) / 2^1075 is halfway between the largest subnormal and the smallest normal number.
// This number has 768 digits, the digits of (2^53 - 1) * 5^1075, and all of them affect the
// rounding.
TEST(a_tie_of_768_digits_is_distinguished_from_its_neighbors)
{
    enum { SIZE = 768 };
    static const char factor[] = "9007199254740991";
    char text[SIZE + 8], digits[SIZE] = {0}; // values of the digits, starting with the last
    for (size_t i = 0; i < 16; i++)
        digits[i] = (char)(factor[15 - i] - '0');
    for (int power = 0; power < 1075; power++) {
        int carry = 0;
        for (size_t i = 0; i < SIZE; i++) {
            carry += 5 * digits[i];
            digits[i] = (char)(carry % 10);
            carry /= 10;
        }
        assert_int_equal(carry, 0);
    }
    for (size_t i = 0; i < SIZE; i++)
        text[i] = (char)('0' + digits[SIZE - 1 - i]);
    assert_true(text[0] != '0' && text[SIZE - 1] == '5');
    strcpy(text + SIZE, "e-1075");
    expect_double(text, 0x1p-1022);
    text[SIZE - 1] = '4';
    expect_double(text, 0x0.fffffffffffffp-1022);
}

TEST(a_locale_with_a_decimal_comma_changes_nothing)
{
    static const char *const names[] = {"de_DE.UTF-8", "de_DE.utf8", "de_DE", "nl_NL.UTF-8",
                                        "fr_FR.UTF-8"};
    const char *found = NULL;
    double value;
    for (size_t i = 0; i < sizeof names / sizeof *names && found == NULL; i++)
        found = setlocale(LC_ALL, names[i]);
    if (found == NULL)
        print_message("no locale with a decimal comma is installed: tested in the C locale\n");
    else
        assert_string_equal(localeconv()->decimal_point, ",");
    expect_double("1.5", 1.5);
    expect_double("0.12345678901234567", 0x1.f9add3746f65ep-4);    // parsed in integers
    expect_double("0.12345678901234567890", 0x1.f9add3746f65fp-4); // parsed by strtod
    assert_int_equal(number_length("1,5", 3, &value), 1);
    setlocale(LC_ALL, "C");
}

TEST(integers_are_read_up_to_the_ends_of_their_range)
{
    static const struct {
        const char *text;
        int64_t value;
        int length;
    } cases[] = {{"0", 0, 1},
                 {"-0", 0, 2},
                 {"+12", 12, 3},
                 {"-12 ", -12, 3},
                 {"007", 7, 3},
                 {"3.5", 3, 1},
                 {"9223372036854775807", INT64_MAX, 19},
                 {"-9223372036854775808", INT64_MIN, 20},
                 {"-9223372036854775800", INT64_MIN + 8, 20},
                 {"000000000000000000000000000000012", 12, 33}};
    static const char *const wrong[] = {"",
                                        "-",
                                        "+",
                                        "x1",
                                        ".5",
                                        "--1",
                                        " 1",
                                        "9223372036854775808",
                                        "-9223372036854775809",
                                        "9223372036854775810",
                                        "99999999999999999999999999"};
    int64_t value;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_int_equal(integer_length(cases[i].text, &value), cases[i].length);
        assert_true(value == cases[i].value);
    }
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        assert_int_equal(integer_length(wrong[i], &value), -1);
}

TEST(multiples_of_ninety_degrees_are_exact)
{
    const double sines[4] = {0, 1, 0, -1};
    for (int turn = -8; turn <= 8; turn++) {
        assert_true(sine_of_degrees(90.0 * turn) == sines[turn & 3]);
        assert_true(cosine_of_degrees(90.0 * turn) == sines[(turn + 1) & 3]);
    }
}

// The tolerance of 4 * 2^-53 covers the rounding errors of the angle and of the series.
TEST(all_angles_agree_with_the_library)
{
    for (double degrees = -400; degrees <= 400; degrees += 0.37) {
        const long double radians = (long double)degrees * 3.14159265358979323846264338L / 180;
        assert_true(fabs(sine_of_degrees(degrees) - (double)sinl(radians)) < 0x1p-51);
        assert_true(fabs(cosine_of_degrees(degrees) - (double)cosl(radians)) < 0x1p-51);
    }
}

// The series yields an eighth of the angle, so its rounding errors count eightfold.
TEST(angles_between_vectors_agree_with_the_library)
{
    for (double degrees = 0; degrees <= 180; degrees += 0.037) {
        const Vec3 a = {cosine_of_degrees(degrees), sine_of_degrees(degrees), 0};
        const Vec3 x = {1, 0, 0}, away = {-1, 0, 0};
        const double angle = (double)atan2l((long double)a.y, (long double)a.x);
        assert_true(fabs(angle_between(a, x) - angle) < 0x1p-48);
        assert_true(fabs(angle_between(away, a) - (3.14159265358979323846 - angle)) < 0x1p-48);
    }
    assert_true(angle_between(vec3(0, 1, 0), vec3(0, 1, 0)) == 0);
}

// vec3_normalize takes another path if squares could overflow or underflow.
TEST(normalized_bits_are_those_of_division_by_a_power_of_two)
{
    for (int exponent = -1000; exponent <= 1000; exponent += 10)
        for (int i = 1; i < 100; i++) {
            const Vec3 a = {1.0 / i, 0.37 * i, 1 - 0.011 * i}, expected = vec3_normalize(a);
            const Vec3 scaled = {scalbn(a.x, exponent), scalbn(a.y, exponent),
                                 scalbn(a.z, exponent)};
            const Vec3 normal = vec3_normalize(scaled);
            assert_memory_equal(&normal, &expected, sizeof normal);
        }
}
