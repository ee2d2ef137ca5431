// SPDX-License-Identifier: MIT
// The figure's head: bald and laughing, with closed eyes and long earlobes.
#include "figure.h"
#include "shape.h"

static double skull(Vec3 p, Vec3 q)
{
    const double crown = shape_ellipsoid(p, vec3(-0.005, 0, 0.028), vec3(0.118, 0.108, 0.112));
    const double jowls = shape_ellipsoid(p, vec3(0.02, 0, -0.05), vec3(0.095, 0.108, 0.078));
    const double cheek = shape_ellipsoid(q, vec3(0.078, 0.054, -0.012), vec3(0.042, 0.04, 0.036));
    const double chin = shape_ellipsoid(p, vec3(0.092, 0, -0.1), vec3(0.03, 0.04, 0.026));
    const double throat = shape_ellipsoid(p, vec3(0.045, 0, -0.118), vec3(0.07, 0.08, 0.032));
    double field = shape_join(crown, jowls, 0.05);
    field = shape_join(field, cheek, 0.025);
    field = shape_join(field, chin, 0.02);
    return shape_join(field, throat, 0.015);
}

static double nose(Vec3 p, Vec3 q)
{
    const double bridge = shape_capsule(p, vec3(0.11, 0, 0.04), vec3(0.13, 0, 0.0), 0.012, 0.018);
    const double wing = shape_sphere(q, vec3(0.118, 0.018, -0.006), 0.014);
    return shape_join(bridge, wing, 0.012);
}

// The crescent of the open mouth in the front view. It extends through the whole head.
typedef struct {
    double opening, upper_lip;
} Mouth;

static Mouth mouth(Vec3 flat)
{
    const double lower = shape_ellipsoid(flat, vec3(0, 0, -0.042), vec3(1, 0.052, 0.038));
    const double upper = shape_ellipsoid(flat, vec3(0, 0, -0.012), vec3(1, 0.075, 0.036));
    return (Mouth){shape_cut(lower, upper, 0.006), upper};
}

// The lines of the face are curves in the front view, projected onto the surface.
static double eye_line(Vec3 flat)
{
    static const Vec3 lid[4] = {
        {0, 0.018, 0.014}, {0, 0.03, 0.042}, {0, 0.062, 0.042}, {0, 0.076, 0.01}};
    return shape_curve(flat, lid, 0, 0);
}

static double brow_line(Vec3 flat)
{
    static const Vec3 arch[4] = {
        {0, 0.014, 0.046}, {0, 0.034, 0.078}, {0, 0.066, 0.074}, {0, 0.088, 0.044}};
    return shape_curve(flat, arch, 0, 0);
}

static double ear(Vec3 q)
{
    const double shell = shape_ellipsoid(q, vec3(-0.012, 0.117, 0.0), vec3(0.032, 0.019, 0.052));
    const double lobe = shape_ellipsoid(q, vec3(-0.004, 0.121, -0.066), vec3(0.018, 0.014, 0.04));
    const double hollow = shape_ellipsoid(q, vec3(0.004, 0.134, 0.004), vec3(0.018, 0.015, 0.034));
    return shape_cut(shape_join(shell, lobe, 0.02), hollow, 0.008);
}

static double front(Vec3 p, Vec3 q)
{
    const Vec3 flat = vec3(0, q.y, q.z);
    double face = shape_join(skull(p, q), nose(p, q), 0.012);
    face = shape_join(face, shape_seam(face, brow_line(flat), 0.006), 0.012);
    const Mouth laugh = mouth(flat);
    const double lips = shape_seam(face, laugh.opening, 0.008);
    const double teeth = shape_larger(face + 0.010, laugh.upper_lip - 0.012);
    const double hollow = shape_larger(laugh.opening, -(face + 0.035));
    const double cavity = shape_cut(hollow, teeth, 0.005);
    face = shape_cut(face, shape_seam(face, eye_line(flat), 0.005), 0.008);
    face = shape_cut(face, cavity, 0.006);
    return shape_join(face, lips, 0.006);
}

double head_field(Vec3 p)
{
    const double far = shape_length(p) - 0.19;
    if (far > SHAPE_FAR)
        return far;
    const Vec3 q = shape_mirror(p);
    const double face = p.x > 0 ? front(p, q) : skull(p, q);
    return shape_join(face, ear(q), 0.007);
}
