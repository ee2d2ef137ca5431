// SPDX-License-Identifier: MIT
// The lotus seat: two rings of rising petals, a ring of hanging petals, and a foot.
#include "figure.h"
#include "shape.h"

// A pointed petal. Its half width is radii.y, and its half length is 0.93 * radii.z. In q's frame,
// x points out of the petal's back and z points to its tip. The center of the ellipsoid is at
// y = -shift. The part with y > 0 and its mirror image (see petal) meet at the ridge and the tip.
static double blade(Vec3 q, Vec3 radii)
{
    const double shift = 0.6 * radii.y;
    return shape_ellipsoid(q, vec3(0, -shift, 0), vec3(radii.x, radii.y + shift, radii.z));
}

// The tip curls outward, and the back carries a smaller petal in relief.
static double petal(Vec3 p)
{
    const double rise = shape_larger(p.z, 0);
    const Vec3 curled = shape_mirror(vec3(p.x - 1.6 * rise * rise, p.y, p.z));
    const double outer = blade(curled, vec3(0.045, 0.082, 0.125));
    const double relief = blade(vec3_sub(curled, vec3(0.019, 0, 0)), vec3(0.045, 0.055, 0.085));
    return shape_join(outer, relief, 0.006);
}

static double wreath(Vec3 p, double offset, Vec3 middle, double lean)
{
    const Vec3 q = shape_repeat(shape_turn_z(p, vec3(0, 0, 0), offset), 16);
    return petal(shape_turn_y(q, middle, lean));
}

double lotus_field(Vec3 p)
{
    if (p.z > 0.28)
        return p.z - 0.25;
    const double inner = wreath(p, 0.5 / 16, vec3(0.345, 0, 0.12), 0.05);
    const double outer = wreath(p, 0, vec3(0.385, 0, 0.105), 0.09);
    const double falling = wreath(p, 0.5 / 16, vec3(0.365, 0, 0.065), 0.37);
    const double core = shape_ellipsoid(p, vec3(0, 0, 0.1), vec3(0.37, 0.37, 0.095));
    const double foot = shape_torus(p, vec3(0, 0, 0.02), 0.375, 0.022);
    double field = shape_join(shape_join(inner, outer, 0.012), falling, 0.012);
    field = shape_join(field, core, 0.015);
    field = shape_join(field, foot, 0.01);
    return shape_overlap(field, -p.z, 0.01);
}
