// SPDX-License-Identifier: MIT
// The figure's hands, and the foot that the robe does not cover.
#include "figure.h"
#include "shape.h"

// A finger of two bones, bent at the middle.
static double finger(Vec3 p, Vec3 root, Vec3 middle, Vec3 tip)
{
    const double first = shape_capsule(p, root, middle, 0.0165, 0.015);
    const double second = shape_capsule(p, middle, tip, 0.015, 0.0125);
    return shape_join(first, second, 0.006);
}

static double right_hand(Vec3 p)
{
    const double far = shape_sphere(p, vec3(0.27, -0.29, 0.33), 0.11);
    if (far > SHAPE_FAR)
        return far;
    const Vec3 q = shape_turn_z(p, vec3(0.235, -0.29, 0.352), -0.06);
    double field = shape_ellipsoid(q, vec3(0, 0, 0), vec3(0.058, 0.05, 0.026));
    for (int number = 0; number < 4; number++) {
        const double y = 0.031 * (number - 1.5), reach = number == 0 || number == 3 ? -0.01 : 0;
        const double digit = finger(q, vec3(0.03, y, 0.004), vec3(0.082 + reach, 1.1 * y, -0.02),
                                    vec3(0.098 + reach, 1.1 * y, -0.062));
        field = shape_join(field, digit, 0.012);
    }
    const double thumb =
        finger(q, vec3(-0.01, 0.035, 0), vec3(0.035, 0.066, -0.005), vec3(0.07, 0.072, -0.016));
    return shape_join(field, thumb, 0.015);
}

static double left_hand(Vec3 p)
{
    const double far = shape_sphere(p, vec3(0.28, 0.23, 0.42), 0.11);
    if (far > SHAPE_FAR)
        return far;
    const Vec3 q = shape_turn_z(p, vec3(0.25, 0.24, 0.395), -0.06);
    double field = shape_ellipsoid(q, vec3(0, 0, 0), vec3(0.058, 0.05, 0.022));
    for (int number = 0; number < 4; number++) {
        const double y = 0.03 * (number - 1.5), reach = number == 0 || number == 3 ? -0.008 : 0;
        const double digit = finger(q, vec3(0.03, y, 0), vec3(0.078 + reach, 1.1 * y, 0.02),
                                    vec3(0.082 + reach, 1.05 * y, 0.062));
        field = shape_join(field, digit, 0.012);
    }
    const double thumb =
        finger(q, vec3(-0.01, -0.035, 0), vec3(0.02, -0.066, 0.02), vec3(0.03, -0.066, 0.06));
    return shape_join(field, thumb, 0.015);
}

static double right_foot(Vec3 p)
{
    const double far = shape_sphere(p, vec3(0.33, 0.14, 0.232), 0.12);
    if (far > SHAPE_FAR)
        return far;
    const Vec3 q = shape_turn_z(p, vec3(0.318, 0.125, 0.240), 0.17);
    double field = shape_ellipsoid(q, vec3(0, 0, 0), vec3(0.085, 0.042, 0.03));
    for (int toe = 0; toe < 5; toe++) {
        const double size = toe == 0 ? 0.02 : 0.0145 - 0.0008 * toe;
        const Vec3 center = vec3(0.088 - 0.006 * toe, 0.028 - 0.0165 * toe, 0.002);
        field = shape_join(field, shape_sphere(q, center, size), 0.008);
    }
    return field;
}

double limbs_field(Vec3 p)
{
    return shape_smaller(p.y < 0 ? right_hand(p) : left_hand(p), right_foot(p));
}
