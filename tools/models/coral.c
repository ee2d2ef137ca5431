// SPDX-License-Identifier: MIT
// The coral: a hollow ball of branches with about a million triangles. The branches form a gyroid
// lattice (Schoen, "Infinite Periodic Minimal Surfaces without Self-Intersections", NASA TN D-5541,
// 1970). A ball of radius HOLLOW_RADIUS fits inside.
#include "model.h"
#include "shape.h"

#define BALL_RADIUS   0.49
#define HOLLOW_RADIUS 0.33
#define PERIODS       8.0 // lattice cells per unit

// Returns the gyroid's level function divided by its approximate slope at the surface. The quotient
// approximates the distance to the surface.
static double gyroid(Vec3 p)
{
    const Vec3 sine = vec3(wave_sine(p.x), wave_sine(p.y), wave_sine(p.z));
    const Vec3 cosine = vec3(wave_cosine(p.x), wave_cosine(p.y), wave_cosine(p.z));
    const double level = sine.x * cosine.y + sine.y * cosine.z + sine.z * cosine.x;
    return level / (1.2 * WAVE_TAU * PERIODS);
}

static double coral_field(Vec3 p)
{
    const Vec3 q = vec3_sub(p, vec3(0, 0, BALL_RADIUS - 0.015));
    const double radius = shape_length(q);
    const double shell = shape_overlap(radius - BALL_RADIUS, HOLLOW_RADIUS - radius, 0.01);
    if (shell > 0.05)
        return shell;
    const double branches = 0.018 - gyroid(vec3_scale(q, PERIODS));
    return shape_overlap(shape_overlap(branches, shell, 0.02), -p.z, 0.01);
}

const Model model_coral = {
    .name = "coral",
    .field = coral_field,
    .low = {-0.52, -0.52, -0.04},
    .high = {0.52, 0.52, 1.0},
    .cell = 0.0042,
};
