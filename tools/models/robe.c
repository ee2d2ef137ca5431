// SPDX-License-Identifier: MIT
// The figure's robe: a cloth over the torso, wide sleeves, and a cloth over the crossed legs. The
// robe is open in front. Folds are waves added to the fields.
#include "figure.h"
#include "shape.h"

// Returns the height of a fold, from -1.05 to 0.57. `along` increases by 1 from fold to fold.
// Crests are round, and valleys are narrower.
static double fold(double along)
{
    return 0.8 * wave_sine(along) + 0.25 * wave_cosine(2 * along);
}

// Folds run around the opening in front, and fan out from the neck on the back.
static double mantle(Vec3 p, double torso)
{
    const double front = shape_ellipsoid(p, vec3(0.25, 0, 0.53), vec3(0.26, 0.16, 0.25));
    const double collar = shape_sphere(p, vec3(0.05, 0, 0.81), 0.145);
    const double opening = shape_join(front, collar, 0.05);
    const double hemmed = shape_step(opening, 0.01, 0.05) * shape_step(p.x, -0.1, 0.0);
    const double fanned = shape_step(p.x, -0.04, -0.1) * shape_step(p.z, 0.70, 0.6);
    const double fan = wave_turns(p.y, 0.9 - p.z) * 36 + 2.5 * p.z;
    const double relief = hemmed * fold(opening * 20 + p.z * 3) + fanned * fold(fan);
    const double cloth = torso - 0.016 - 0.007 * relief;
    const double open = shape_cut(cloth, opening, 0.012);
    return shape_join(open, shape_seam(cloth, opening, 0.015), 0.01);
}

// The robe's hem lies on the seat in pleats.
static double skirt(Vec3 p)
{
    const double pleats = wave_turns(p.y, p.x + 0.05) * 40;
    const double cloth = shape_ellipsoid(p, vec3(-0.05, 0, 0.235), vec3(0.25, 0.32, 0.075));
    return cloth - 0.008 * fold(pleats + 4 * p.z) * shape_step(p.z, 0.33, 0.27);
}

static double sleeve(Vec3 p, Vec3 elbow, Vec3 wrist)
{
    const double far = shape_sphere(p, vec3(0.07, 0.26, 0.5), 0.27);
    if (far > SHAPE_FAR)
        return far;
    const Vec3 shoulder = vec3(-0.02, 0.205, 0.635);
    const Vec3 along = vec3_normalize(vec3_sub(wrist, elbow));
    const double past = vec3_dot(vec3_sub(p, wrist), along);
    const Vec3 end = vec3_add(wrist, vec3_scale(along, 0.08));
    const double upper = shape_capsule(p, shoulder, elbow, 0.085, 0.078);
    const double lower = shape_capsule(p, elbow, end, 0.072, 0.076);
    const Vec3 hang = vec3(elbow.x + 0.05, elbow.y - 0.01, elbow.z - 0.05);
    const double drop = shape_ellipsoid(p, hang, vec3(0.09, 0.05, 0.07));
    double cloth = shape_join(shape_join(upper, lower, 0.05), drop, 0.06);
    cloth -= 0.007 * fold((p.z * 0.8 - p.x * 0.9 + p.y * 0.3) * 17) * shape_step(past, 0.0, -0.08) *
             shape_step(p.z, 0.66, 0.58);
    const double inside = shape_capsule(p, elbow, end, 0.055, 0.055);
    const double cuff = shape_seam(cloth, past, 0.012);
    cloth = shape_join(shape_overlap(cloth, past, 0.01), cuff, 0.008);
    const double hollow = shape_overlap(inside, -past - 0.035, 0.01);
    const double arm = shape_capsule(p, elbow, end, 0.05, 0.036);
    return shape_join(shape_cut(cloth, hollow, 0.01), arm, 0.008);
}

static double sleeves(Vec3 p)
{
    if (p.y > 0)
        return sleeve(p, vec3(0.0, 0.30, 0.45), vec3(0.17, 0.265, 0.40));
    return sleeve(shape_mirror(p), vec3(0.0, 0.30, 0.45), vec3(0.16, 0.29, 0.37));
}

// Folds run along the shin and obliquely across the thigh. They fade out near the knee.
static double leg(Vec3 p, Vec3 hip, Vec3 knee, Vec3 ankle)
{
    const double thigh = shape_capsule(p, hip, knee, 0.11, 0.088);
    const double shin = shape_capsule(p, knee, ankle, 0.082, 0.052);
    const Vec3 from = vec3_sub(p, knee);
    const double bare = shape_length(from);
    const double depth = 0.006 * shape_step(bare, 0.09, 0.2);
    return shape_join(thigh, shin, 0.03) - depth * fold(15 * from.z - 9 * from.x + 5 * bare);
}

static double lap(Vec3 p)
{
    const double left =
        leg(p, vec3(0, 0.12, 0.28), vec3(0.19, 0.32, 0.262), vec3(0.25, -0.12, 0.25));
    const double right =
        leg(p, vec3(0, -0.12, 0.28), vec3(0.19, -0.32, 0.262), vec3(0.31, 0.07, 0.235));
    return shape_join(left, right, 0.02);
}

double robe_field(Vec3 p, double torso)
{
    const double upper = shape_join(mantle(p, torso), sleeves(p), 0.03);
    return shape_join(upper, shape_join(lap(p), skirt(p), 0.02), 0.025);
}
