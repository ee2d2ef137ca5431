// SPDX-License-Identifier: MIT
// Compares base/number with known bit patterns, and with the C library's strtod in the C locale.
#include "base/number.h"

#include "unit/cmocka_all.h"

#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// A copy without spare bytes, so that sanitizers detect every access beyond the end.
typedef struct {
    char *text, *end;
} Copy;

static Copy copy_make(const char *text, size_t size)
{
    Copy copy = {malloc(size + (size == 0)), NULL};
    assert_non_null(copy.text);
    memcpy(copy.text, text, size);
    copy.end = copy.text + size;
    return copy;
}

// Returns the value of a text that must be a number to its end.
static double value_of(const char *text)
{
    const Copy copy = copy_make(text, strlen(text));
    double value = 42;
    const char *stop = number_parse(copy.text, copy.end, &value);
    if (stop != copy.end)
        fail_msg("'%.60s' is not read to its end", text);
    free(copy.text);
    return value;
}

static void assert_same_double(double value, double expected, const char *text)
{
    if (memcmp(&value, &expected, sizeof value) != 0)
        fail_msg("'%.60s' gives %a instead of %a", text, value, expected);
}

// Returns the length of the number at the start of text, or -1 without a number.
static int length_of(const char *text)
{
    const Copy copy = copy_make(text, strlen(text));
    double value;
    const char *stop = number_parse(copy.text, copy.end, &value);
    const int length = stop == NULL ? -1 : (int)(stop - copy.text);
    free(copy.text);
    return length;
}

static uint64_t next_random(uint64_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return *state;
}

TEST(every_spelling_of_a_decimal_is_read)
{
    static const struct {
        const char *text;
        double value;
    } cases[] = {
        {"0", 0},
        {"-0", -0.0},
        {"7", 7},
        {"-7", -7},
        {"+7", 7},
        {"1.5", 1.5},
        {"-.5", -.5},
        {"5.", 5},
        {"00012.500", 12.5},
        {"1e3", 1e3},
        {"1E+3", 1e3},
        {"2.5e-3", 2.5e-3},
        {".5e1", 5},
        {"5.e1", 50},
        {"-0.991745102557", -0.991745102557},
        {"0.1", 0.1},
        {"123456789012", 123456789012.0},
    };
    for (size_t index = 0; index < sizeof cases / sizeof *cases; index++)
        assert_same_double(value_of(cases[index].text), cases[index].value, cases[index].text);
}

TEST(a_number_stops_where_the_grammar_does)
{
    assert_int_equal(length_of("1e"), 1);
    assert_int_equal(length_of("1e+"), 1);
    assert_int_equal(length_of("1e-x"), 1);
    assert_int_equal(length_of("1.5.2"), 3);
    assert_int_equal(length_of("1,5"), 1);
    assert_int_equal(length_of("0x10"), 1);
    assert_int_equal(length_of("12abc"), 2);
    assert_int_equal(length_of("1-2"), 1);
    assert_int_equal(length_of("3 4"), 1);
    assert_int_equal(length_of("1e5e5"), 3);
}

TEST(what_is_no_number_is_refused)
{
    static const char *const texts[] = {"",    "-",   "+",   ".",  "-.",   "e5",       ".e5", "inf",
                                        "nan", "INF", "+-1", " 1", "-nan", "nan(0x1)", ",5"};
    for (size_t index = 0; index < sizeof texts / sizeof *texts; index++)
        assert_int_equal(length_of(texts[index]), -1);
}

TEST(nothing_beyond_the_end_is_looked_at)
{
    static const char text[] = "-12.75e-12";
    for (size_t size = 0; size <= strlen(text); size++) {
        const Copy copy = copy_make(text, size);
        double value = 0;
        const char *stop = number_parse(copy.text, copy.end, &value);
        if (stop != NULL) {
            char terminated[sizeof text] = "";
            memcpy(terminated, text, size);
            assert_same_double(value, strtod(terminated, NULL), terminated);
        }
        assert_true((stop == NULL) == (size < 2));
        free(copy.text);
    }
}

TEST(hard_cases_round_to_the_nearest_double)
{
    static const struct {
        const char *text;
        double value;
    } cases[] = {
        {"9007199254740991", 0x1.fffffffffffffp52},
        {"9007199254740993", 0x1p53}, // a tie is rounded to even
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
        {"20828936362704393e-27", 0x1.6e6d30a690f5dp-36},
    };
    for (size_t index = 0; index < sizeof cases / sizeof *cases; index++)
        assert_same_double(value_of(cases[index].text), cases[index].value, cases[index].text);
}

TEST(a_value_past_the_range_is_an_infinity_or_zero)
{
    assert_same_double(value_of("1e309"), HUGE_VAL, "1e309");
    assert_same_double(value_of("-1e309"), -HUGE_VAL, "-1e309");
    assert_same_double(value_of("1e99999999999999999999999"), HUGE_VAL, "a long exponent");
    assert_same_double(value_of("1e-400"), 0, "1e-400");
    assert_same_double(value_of("-1e-99999999999999999999999"), -0.0, "a long exponent");
    assert_same_double(value_of("0e99999999999999999999999"), 0, "0e99");
    assert_same_double(value_of("-0.0e-5"), -0.0, "-0.0e-5");
}

TEST(random_spellings_agree_with_the_c_library)
{
    uint64_t random = 88172645463325252u;
    for (int round = 0; round < 200000; round++) {
        char text[64];
        const int digits = (int)(next_random(&random) % 20) + 1;
        const int range = round % 2 == 0 ? 46 : 660;
        const int exponent = (int)(next_random(&random) % (uint64_t)range) - range / 2;
        const int whole = (int)(next_random(&random) % (uint64_t)(digits + 1));
        char spelled[32];
        snprintf(spelled, sizeof spelled, "%020llu", (unsigned long long)next_random(&random));
        snprintf(text, sizeof text, "%s%.*s.%.*se%d", round % 3 == 0 ? "-" : "", whole, spelled,
                 digits - whole, spelled + whole, exponent);
        assert_same_double(value_of(text), strtod(text, NULL), text);
    }
}

TEST(a_double_printed_with_17_digits_comes_back)
{
    uint64_t random = 362436069362436069u;
    for (int round = 0; round < 200000; round++) {
        const uint64_t bits = next_random(&random);
        double value;
        memcpy(&value, &bits, sizeof value);
        char text[64];
        snprintf(text, sizeof text, "%.17g", value);
        if (isfinite(value))
            assert_same_double(value_of(text), value, text);
    }
}

// Returns the value of head, a million zeros, and tail.
static double value_around_zeros(const char *head, const char *tail)
{
    const size_t zeros = 1000000;
    char *text = malloc(strlen(head) + zeros + strlen(tail) + 1);
    assert_non_null(text);
    strcpy(text, head);
    memset(text + strlen(head), '0', zeros);
    strcpy(text + strlen(head) + zeros, tail);
    const double value = value_of(text);
    free(text);
    return value;
}

TEST(a_token_of_a_megabyte_is_still_rounded_correctly)
{
    assert_same_double(value_around_zeros("0.", "1e1000001"), 1, "0.0...01e1000001");
    assert_same_double(value_around_zeros("1", "e-1000000"), 1, "10...0e-1000000");
    assert_same_double(value_around_zeros("", "12.5"), 12.5, "0...012.5");
    assert_same_double(value_around_zeros("1.5", ""), 1.5, "1.50...0");
    assert_same_double(value_around_zeros("9007199254740993.", ""), 0x1p53, "an exact tie");
    assert_same_double(value_around_zeros("9007199254740993.", "1"), 0x1.0000000000001p53,
                       "barely above a tie");
    assert_same_double(value_around_zeros("1", ""), HUGE_VAL, "10...0");
}

// (2^53 - 1) / 2^1075 is halfway between the largest subnormal and the smallest normal number.
// Rounding it depends on all of its 768 digits.
TEST(a_tie_of_768_digits_is_told_from_its_neighbors)
{
    char text[800] = "9007199254740991"; // (2^53 - 1) / 2^1075 is this times 5^1075, divided by
    // 10^1075
    const size_t size = 768;
    char digits[800] = {0}; // values of the digits, starting with the last
    for (size_t index = 0; index < 16; index++)
        digits[index] = (char)(text[15 - index] - '0');
    for (int power = 0; power < 1075; power++) {
        int carry = 0;
        for (size_t index = 0; index < size; index++) {
            carry += 5 * digits[index];
            digits[index] = (char)(carry % 10);
            carry /= 10;
        }
        assert_int_equal(carry, 0);
    }
    for (size_t index = 0; index < size; index++)
        text[index] = (char)('0' + digits[size - 1 - index]);
    assert_true(text[0] != '0' && text[size - 1] == '5');
    strcpy(text + size, "e-1075");
    assert_same_double(value_of(text), 0x1p-1022, "the tie");
    text[size - 1] = '4';
    assert_same_double(value_of(text), 0x0.fffffffffffffp-1022, "just below the tie");
}

TEST(a_locale_with_a_decimal_comma_changes_nothing)
{
    static const char *const names[] = {"de_DE.UTF-8", "de_DE.utf8", "de_DE", "nl_NL.UTF-8",
                                        "fr_FR.UTF-8"};
    const char *found = NULL;
    for (size_t index = 0; index < sizeof names / sizeof *names && found == NULL; index++)
        found = setlocale(LC_ALL, names[index]);
    if (found == NULL)
        print_message("no locale with a decimal comma is installed: tested in the C locale\n");
    else
        assert_string_equal(localeconv()->decimal_point, ",");
    assert_same_double(value_of("1.5"), 1.5, "1.5");
    assert_same_double(value_of("0.12345678901234567"), 0x1.f9add3746f65ep-4, "in integers");
    assert_same_double(value_of("0.12345678901234567890"), 0x1.f9add3746f65fp-4, "by strtod");
    assert_int_equal(length_of("1,5"), 1);
    setlocale(LC_ALL, "C");
}

// Returns the length of the integer at the start of text, or -1 without an integer.
static int integer_length(const char *text, int64_t *value)
{
    const Copy copy = copy_make(text, strlen(text));
    const char *stop = integer_parse(copy.text, copy.end, value);
    const int length = stop == NULL ? -1 : (int)(stop - copy.text);
    free(copy.text);
    return length;
}

TEST(integers_are_read_up_to_the_ends_of_their_range)
{
    static const struct {
        const char *text;
        int64_t value;
        int length;
    } cases[] = {
        {"0", 0, 1},
        {"-0", 0, 2},
        {"+12", 12, 3},
        {"-12 ", -12, 3},
        {"007", 7, 3},
        {"3.5", 3, 1},
        {"9223372036854775807", INT64_MAX, 19},
        {"-9223372036854775808", INT64_MIN, 20},
        {"-9223372036854775800", INT64_MIN + 8, 20},
        {"000000000000000000000000000000012", 12, 33},
    };
    for (size_t index = 0; index < sizeof cases / sizeof *cases; index++) {
        int64_t value = 42;
        assert_int_equal(integer_length(cases[index].text, &value), cases[index].length);
        assert_true(value == cases[index].value);
    }
}

TEST(what_is_no_integer_of_64_bits_is_refused)
{
    static const char *const texts[] = {"",
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
    for (size_t index = 0; index < sizeof texts / sizeof *texts; index++)
        assert_int_equal(integer_length(texts[index], &value), -1);
}
