// SPDX-License-Identifier: MIT
// The creature: a walking elephant calf with a raised trunk and about six thousand triangles. It
// looks along +x and stands on z = 0.
#include "model.h"
#include "shape.h"

static double leg(Vec3 p, Vec3 hip, Vec3 foot)
{
    const Vec3 toes = vec3(foot.x + 0.022, foot.y, 0.035);
    const double shaft = shape_capsule(p, hip, foot, 0.105, 0.07);
    const double sole = shape_ellipsoid(p, toes, vec3(0.09, 0.085, 0.055));
    return shape_join(shaft, sole, 0.06);
}

// The legs of a diagonal pair swing together, as in a walk.
static double legs(Vec3 p)
{
    const double front_left = leg(p, vec3(0.12, 0.10, 0.36), vec3(0.18, 0.115, 0.05));
    const double front_right = leg(p, vec3(0.12, -0.10, 0.36), vec3(0.07, -0.115, 0.05));
    const double back_left = leg(p, vec3(-0.21, 0.10, 0.36), vec3(-0.27, 0.115, 0.05));
    const double back_right = leg(p, vec3(-0.21, -0.10, 0.36), vec3(-0.15, -0.115, 0.05));
    return shape_smaller(shape_smaller(front_left, front_right),
                         shape_smaller(back_left, back_right));
}

static double torso(Vec3 p)
{
    const double shoulders = shape_ellipsoid(p, vec3(0.08, 0, 0.44), vec3(0.18, 0.185, 0.19));
    const double rump = shape_ellipsoid(p, vec3(-0.19, 0, 0.43), vec3(0.20, 0.20, 0.21));
    const double belly = shape_ellipsoid(p, vec3(-0.05, 0, 0.36), vec3(0.25, 0.20, 0.17));
    return shape_join(shape_join(shoulders, rump, 0.15), belly, 0.08);
}

static double tail(Vec3 p)
{
    const Vec3 root = vec3(-0.36, 0, 0.50), bend = vec3(-0.45, 0.02, 0.40);
    const Vec3 end = vec3(-0.47, 0.05, 0.27);
    const double upper = shape_capsule(p, root, bend, 0.035, 0.024);
    const double lower = shape_capsule(p, bend, end, 0.024, 0.02);
    const double tuft = shape_ellipsoid(p, vec3(-0.472, 0.055, 0.245), vec3(0.035, 0.035, 0.06));
    return shape_join(shape_join(upper, lower, 0.03), tuft, 0.04);
}

static double trunk(Vec3 p)
{
    static const Vec3 course[4] = {
        {0.06, 0, 0.0}, {0.27, 0, -0.28}, {0.55, 0, -0.10}, {0.36, 0, 0.26}};
    const double tube = shape_curve(p, course, 0.10, 0.042);
    const double tip = shape_ellipsoid(p, vec3(0.385, 0, 0.215), vec3(0.055, 0.052, 0.045));
    return shape_join(tube, tip, 0.05);
}

static double ear(Vec3 p)
{
    const Vec3 q =
        shape_turn_z(shape_turn_x(p, vec3(-0.05, 0.12, 0.05), 0.03), vec3(0, 0, 0), 0.075);
    const double flap = shape_ellipsoid(q, vec3(0, 0.14, 0.02), vec3(0.058, 0.175, 0.17));
    const double lobe = shape_ellipsoid(q, vec3(0.0, 0.11, -0.11), vec3(0.055, 0.11, 0.14));
    const double dish = shape_ellipsoid(q, vec3(0.085, 0.12, -0.01), vec3(0.06, 0.12, 0.15));
    return shape_cut(shape_join(flap, lobe, 0.08), dish, 0.06);
}

// p is in the head's frame, in which the head looks along +x.
static double head(Vec3 p)
{
    const Vec3 q = shape_mirror(p);
    const double skull = shape_ellipsoid(p, vec3(0, 0, 0.03), vec3(0.17, 0.16, 0.175));
    const double brow = shape_ellipsoid(q, vec3(0.06, 0.05, 0.11), vec3(0.10, 0.085, 0.08));
    const double cheek = shape_ellipsoid(q, vec3(0.07, 0.065, -0.07), vec3(0.105, 0.085, 0.09));
    const double lip = shape_capsule(p, vec3(0.03, 0, -0.13), vec3(0.125, 0, -0.225), 0.075, 0.05);
    double field = shape_join(shape_join(skull, brow, 0.06), cheek, 0.06);
    field = shape_join(field, lip, 0.04);
    field = shape_join(field, trunk(p), 0.05);
    return shape_join(field, ear(q), 0.05);
}

static double creature_field(Vec3 p)
{
    const double trunk_and_legs = shape_join(torso(p), legs(p), 0.07);
    const double body = shape_join(trunk_and_legs, tail(p), 0.03);
    const double whole = shape_join(
        body, 1.12 * head(vec3_scale(shape_turn_z(p, vec3(0.27, 0, 0.61), 0.02), 1 / 1.12)), 0.08);
    return shape_overlap(whole, -p.z, 0.03);
}

const Model model_creature = {
    .name = "creature",
    .field = creature_field,
    .low = {-0.62, -0.52, -0.1},
    .high = {0.82, 0.52, 1.0},
    .cell = 0.0345,
};
