// SPDX-License-Identifier: MIT
// Converts decimal text to int64_t or to a correctly rounded double, in every locale. The digits
// are gathered in a 64-bit integer, which holds any 19 digits. One of three methods then applies
// the power of ten:
// 1. If the integer and the power are exact doubles, one multiplication or division is correctly
// rounded (William D. Clinger, "How to Read Floating Point Numbers Accurately", PLDI 1990).
// 2. For powers from 10^-27 to 10^27, a 128-bit integer holds the exact product with the power of
// five, or at least 63 bits of the quotient. The quotient's last bit is set if there is a
// remainder. Only the conversion of this integer to double rounds. The power of two is exact.
// 3. All other numbers are rewritten as DIGITSeEXPONENT for strtod. This form has no decimal point,
// so strtod reads it alike in every locale.
//
// Invariant: the result is the double nearest to the decimal number, which may have any length.
// Ties go to the even double.
#include "base/number.h"

#include <float.h>
#include <inttypes.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

_Static_assert(FLT_EVAL_METHOD == 0, "wider intermediate results would be rounded twice");

#define EXACT_MANTISSA    ((uint64_t)1 << 53)
#define MANTISSA_DIGITS   19    // any 19 digits fit in 64 bits
#define SUFFICIENT_DIGITS 800   // 768 digits suffice to decide every tie between two doubles
#define EXPONENT_BOUND    10000 // beyond this, the result is infinity or zero

static const double powers_of_ten[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                       1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                       1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

#define EXACT_POWER ((int64_t)(sizeof powers_of_ten / sizeof *powers_of_ten) - 1)
#define WIDE_POWER  27 // 5^27 is the largest power of five in 64 bits

__extension__ typedef unsigned __int128 Wide;

static bool is_digit(char character)
{
    return character >= '0' && character <= '9';
}

static const char *skip_sign(const char *text, const char *end, bool *negative)
{
    *negative = text < end && *text == '-';
    return text < end && (*text == '-' || *text == '+') ? text + 1 : text;
}

// Appends the digits at `text` to *mantissa, which wraps on overflow. Returns the end of the
// digits.
static const char *gather_digits(const char *text, const char *end, uint64_t *mantissa)
{
    for (; text < end && is_digit(*text); text++)
        *mantissa = *mantissa * 10 + (uint64_t)(*text - '0');
    return text;
}

// If an exponent starts at `text`, adds it to *exponent and returns its end. Otherwise, returns
// `text`. An "e" without digits is not an exponent.
static const char *scan_exponent(const char *text, const char *end, int64_t *exponent)
{
    if (text == end || (*text != 'e' && *text != 'E'))
        return text;
    bool negative;
    const char *digits = skip_sign(text + 1, end, &negative);
    const char *stop = digits;
    int64_t size = 0;
    for (; stop < end && is_digit(*stop); stop++) {
        if (size < INT64_MAX / 100) // no file has enough digits to cancel a larger exponent
            size = size * 10 + (*stop - '0');
    }
    if (stop == digits)
        return text;
    *exponent += negative ? -size : size;
    return stop;
}

// Reads the digits from `text` to `end` as one integer, ignoring a decimal point. Returns this
// integer times ten to the power of `exponent`. Keeps only the first SUFFICIENT_DIGITS digits. If a
// dropped digit is not zero, appends a digit 1.
static double round_slowly(const char *text, const char *end, int64_t exponent)
{
    char spelled[SUFFICIENT_DIGITS + 32];
    size_t count = 0;
    bool inexact = false;
    for (; text < end; text++) {
        if (*text == '.' || (count == 0 && *text == '0'))
            continue;
        if (count < SUFFICIENT_DIGITS) {
            spelled[count++] = *text;
        } else {
            inexact = inexact || *text != '0';
            exponent++;
        }
    }
    if (count == 0)
        return 0;
    if (exponent > EXPONENT_BOUND || exponent < -EXPONENT_BOUND)
        exponent = exponent > 0 ? EXPONENT_BOUND : -EXPONENT_BOUND;
    snprintf(spelled + count, sizeof spelled - count, "%se%" PRId64, inexact ? "1" : "",
             inexact ? exponent - 1 : exponent);
    return strtod(spelled, NULL);
}

// Returns `mantissa` times ten to the power of `exponent`, which is from -WIDE_POWER to WIDE_POWER.
// Integer arithmetic applies the power of five. After the conversion to double, ldexp applies the
// power of two without error.
static double round_widely(uint64_t mantissa, int64_t exponent)
{
    uint64_t power = 1;
    for (int64_t size = exponent < 0 ? -exponent : exponent; size > 0; size--)
        power *= 5;
    if (mantissa == 0)
        return 0;
    if (exponent >= 0)
        return ldexp((double)((Wide)mantissa * power), (int)exponent);
    // The shift gives the quotient at least 63 bits. The quotient's last bit, far below the
    // rounding position, records whether the division left a remainder.
    const int shift = 63 + __builtin_clzll(mantissa);
    const Wide dividend = (Wide)mantissa << shift;
    const Wide quotient = dividend / power;
    const bool inexact = quotient * power != dividend;
    return ldexp((double)(quotient | inexact), (int)exponent - shift);
}

const char *number_parse(const char *text, const char *end, double *value)
{
    bool negative;
    uint64_t mantissa = 0;
    int64_t exponent = 0;
    const char *first = skip_sign(text, end, &negative);
    const char *stop = gather_digits(first, end, &mantissa);
    ptrdiff_t digit_count = stop - first;
    if (stop < end && *stop == '.') {
        const char *fraction = stop + 1;
        stop = gather_digits(fraction, end, &mantissa);
        exponent = fraction - stop;
        digit_count += stop - fraction;
    }
    if (digit_count == 0)
        return NULL;
    const char *after = scan_exponent(stop, end, &exponent);

    double magnitude;
    if (digit_count > MANTISSA_DIGITS || exponent > WIDE_POWER || exponent < -WIDE_POWER)
        magnitude = round_slowly(first, stop, exponent);
    else if (mantissa > EXACT_MANTISSA || exponent > EXACT_POWER || exponent < -EXACT_POWER)
        magnitude = round_widely(mantissa, exponent);
    else if (exponent < 0)
        magnitude = (double)mantissa / powers_of_ten[-exponent];
    else
        magnitude = (double)mantissa * powers_of_ten[exponent];
    *value = negative ? -magnitude : magnitude;
    return after;
}

const char *integer_parse(const char *text, const char *end, int64_t *value)
{
    bool negative;
    const char *first = skip_sign(text, end, &negative);
    const char *stop = first;
    int64_t sum = 0; // negated, because the magnitude of INT64_MIN would overflow
    for (; stop < end && is_digit(*stop); stop++) {
        const int digit = *stop - '0';
        if (sum < (INT64_MIN + digit) / 10)
            return NULL;
        sum = sum * 10 - digit;
    }
    if (stop == first || (!negative && sum == INT64_MIN))
        return NULL;
    *value = negative ? sum : -sum;
    return stop;
}
