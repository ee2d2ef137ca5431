// SPDX-License-Identifier: MIT
// The vase: a hollow solid of revolution with about 130 thousand triangles. Its vertices have the
// colors of a painted pot.
#include "model.h"
#include "shape.h"

#define WALL 0.028

// The radius at a height is MEAN + SWING * cos((z - BELLY) / PERIOD), with angles in turns.
#define MEAN   0.23
#define SWING  0.11
#define BELLY  0.38
#define PERIOD 0.92

// Returns the approximate distance from the vase's outer side.
static double side_field(Vec3 p)
{
    const double turns = (p.z - BELLY) / PERIOD;
    const double slope = SWING * WAVE_TAU / PERIOD * wave_sine(turns);
    const double out = sqrt(p.x * p.x + p.y * p.y) - MEAN - SWING * wave_cosine(turns);
    return out / sqrt(1 + slope * slope);
}

static double vase_field(Vec3 p)
{
    const double side = side_field(p);
    const double body = shape_overlap(side, shape_larger(-p.z, p.z - 1), 0.02);
    const double hollow = shape_overlap(side + WALL, 0.05 - p.z, 0.02);
    return shape_cut(body, hollow, 0.02);
}

static Vec3 mixed(Vec3 a, Vec3 b, double part)
{
    return vec3_add(vec3_scale(a, 1 - part), vec3_scale(b, part));
}

// Returns 1 on a line of this width and 0 beside it. `distance` is from the line's middle.
static double line(double distance, double width)
{
    return shape_step(fabs(distance), width / 2 + 0.004, width / 2 - 0.004);
}

// Paints waves around the belly, flames above the foot and rings below the lip.
static Vec3 vase_color(Vec3 p)
{
    const Vec3 clay = {0.80, 0.40, 0.20}, cream = {0.95, 0.88, 0.72}, ink = {0.07, 0.12, 0.28},
               gold = {0.92, 0.68, 0.16};
    const double turns = wave_turns(p.y, p.x), wave = 0.03 * wave_sine(9 * turns);
    const double flame = 0.13 + 0.07 * fabs(wave_sine(6 * turns));
    Vec3 color = mixed(clay, cream, line(p.z - BELLY, 0.24));
    color = mixed(color, ink, line(p.z - BELLY - wave, 0.035));
    color = mixed(color, gold, line(p.z - BELLY + wave, 0.035));
    color = mixed(color, ink, line(fabs(p.z - BELLY) - 0.12, 0.02));
    color = mixed(color, ink, shape_step(p.z, flame + 0.006, flame - 0.006));
    color = mixed(color, gold, shape_step(p.z, flame - 0.034, flame - 0.046));
    color = mixed(color, ink, shape_step(p.z, 0.7, 0.9) * line(wave_sine(18 * p.z), 0.9));
    return mixed(color, ink, shape_step(side_field(p), -0.01, -0.02));
}

const Model model_vase = {
    .name = "vase",
    .field = vase_field,
    .color = vase_color,
    .low = {-0.38, -0.38, -0.04},
    .high = {0.38, 0.38, 1.04},
    .cell = 0.0085,
};
