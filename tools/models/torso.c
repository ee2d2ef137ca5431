// SPDX-License-Identifier: MIT
// The figure's bare torso, with a large round belly, and its string of beads.
#include "figure.h"
#include "shape.h"

#define BEAD_COUNT    26
#define BEAD_RADIUS   0.0155
#define STRING_RADIUS 0.128

double torso_field(Vec3 p)
{
    const Vec3 q = shape_mirror(p);
    const double hips = shape_ellipsoid(p, vec3(-0.02, 0, 0.33), vec3(0.21, 0.27, 0.13));
    const double belly = shape_ellipsoid(p, vec3(0.065, 0, 0.425), vec3(0.20, 0.225, 0.165));
    const double chest = shape_ellipsoid(p, vec3(-0.01, 0, 0.58), vec3(0.14, 0.19, 0.13));
    const Vec3 soft = vec3(0.06, 0.085, 0.052);
    const double breasts = shape_join(shape_ellipsoid(p, vec3(0.09, 0.08, 0.585), soft),
                                      shape_ellipsoid(p, vec3(0.09, -0.08, 0.585), soft), 0.04);
    const double shoulder = shape_ellipsoid(q, vec3(-0.02, 0.17, 0.64), vec3(0.085, 0.09, 0.07));
    const double neck = shape_capsule(p, vec3(-0.02, 0, 0.65), vec3(0.01, 0, 0.76), 0.09, 0.075);
    const double navel = shape_ellipsoid(p, vec3(0.27, 0, 0.415), vec3(0.03, 0.016, 0.010));
    double field = shape_join(hips, belly, 0.06);
    field = shape_join(field, chest, 0.05);
    field = shape_join(field, breasts, 0.03);
    field = shape_join(field, shoulder, 0.06);
    field = shape_join(field, neck, 0.04);
    return shape_cut(field, navel, 0.025);
}

// Balls along the line where the torso intersects a cylinder parallel to x.
double beads_field(Vec3 p, double torso)
{
    if (p.x < 0 || p.z > 0.665)
        return HUGE_VAL;
    const double y = p.y, z = p.z - 0.645;
    const double around = wave_turns(z, y) * BEAD_COUNT;
    const double out = sqrt(y * y + z * z);
    const double beside = (around - floor(around) - 0.5) / BEAD_COUNT * WAVE_TAU * out;
    const double across = out - STRING_RADIUS, off = torso - 0.8 * BEAD_RADIUS;
    return sqrt(off * off + across * across + beside * beside) - BEAD_RADIUS;
}
