// SPDX-License-Identifier: MIT
// Sine, cosine and arctangent by Taylor polynomials. Sine and cosine first reduce the angle to at
// most 45 degrees, without error. The arctangent halves its angle twice, to at most 11.25 degrees.
// All omitted Taylor terms are below 2^-55.
#include "base/vec.h"

#include <math.h>
#include <stdbool.h>

#define RADIANS_PER_DEGREE 0.017453292519943295

#define TERMS 8

// Returns the polynomial with these coefficients, the highest first, by Horner's method.
static double polynomial(const double coefficients[TERMS], double x)
{
    double sum = coefficients[0];
    for (int i = 1; i < TERMS; i++)
        sum = sum * x + coefficients[i];
    return sum;
}

static double sine_series(double x)
{
    static const double terms[TERMS] = {
        1.0 / 355687428096000.0, -1.0 / 1307674368000.0, 1.0 / 6227020800.0, -1.0 / 39916800.0,
        1.0 / 362880.0,          -1.0 / 5040.0,          1.0 / 120.0,        -1.0 / 6.0};
    return x + x * (x * x) * polynomial(terms, x * x);
}

static double cosine_series(double x)
{
    static const double terms[TERMS] = {
        1.0 / 20922789888000.0, -1.0 / 87178291200.0, 1.0 / 479001600.0, -1.0 / 3628800.0,
        1.0 / 40320.0,          -1.0 / 720.0,         1.0 / 24.0,        -1.0 / 2.0};
    return 1.0 + x * x * polynomial(terms, x * x);
}

// Returns the sine of `degrees` + 90 * `quarters`. This sum is never computed or rounded, because
// `quarters` only selects a polynomial and a sign.
static double sine_ahead(double degrees, int quarters)
{
    const double turns = rint(degrees / 90.0);
    const double radians = (degrees - turns * 90.0) * RADIANS_PER_DEGREE;
    switch (((long long)turns + quarters) & 3) {
    case 0:
        return sine_series(radians);
    case 1:
        return cosine_series(radians);
    case 2:
        return -sine_series(radians);
    default:
        return -cosine_series(radians);
    }
}

double sine_of_degrees(double degrees)
{
    return sine_ahead(degrees, 0);
}

double cosine_of_degrees(double degrees)
{
    return sine_ahead(degrees, 1);
}

// Uses tan(angle / 2) = |a - b| / |a + b|, which is accurate for all angles.
double angle_between(Vec3 a, Vec3 b)
{
    const Vec3 difference = vec3_sub(a, b), sum = vec3_add(a, b);
    const double opposite = vec3_dot(difference, difference), adjacent = vec3_dot(sum, sum);
    const bool is_acute = opposite <= adjacent;
    double tangent = sqrt(is_acute ? opposite / adjacent : adjacent / opposite), series = 0;
    for (int half = 0; half < 2; half++)
        tangent /= 1 + sqrt(1 + tangent * tangent);
    for (int odd = 21; odd > 0; odd -= 2)
        series = 1.0 / odd - tangent * tangent * series;
    const double angle = 8 * tangent * series;
    return is_acute ? angle : 180 * RADIANS_PER_DEGREE - angle;
}
