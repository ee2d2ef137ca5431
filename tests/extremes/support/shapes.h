// SPDX-License-Identifier: MIT
// The meshes that the extremes are made of.  Vertices are rounded to float in the file's own
// coordinates first, as a file would give them: far from the origin that deforms the shape, and
// every vertex of a neighbor with it.
#pragma once

#include "random.h"
#include "scene/scene.h"

// The float nearest to value.  Through memory, since gcc 12 takes two neighboring conversions to
// float and back for none.
static inline double shape_rounded(double value)
{
    const volatile float rounded = (float)value;
    return (double)rounded;
}

// A mesh of so many vertices and triangles, both for the caller to fill.
Mesh shape_unfilled(size_t vertices, size_t triangles);

// Where S(n, k) lies: (s, -0.75 s, 0.5 s) for s = 2^k.
Vec3 shape_center(int exponent);

#define SPHERE_RADIUS 2.0

// S(n): a closed sphere of rings bands from pole to pole, each of 2 * rings quads of two triangles.
Mesh shape_sphere(uint32_t rings, Vec3 center);

// A closed globe of 16 x 16 bands whose vertices lie 1 to 6 from center, each as random will have
// it (after the bumpy sphere of pbrt's tests).
Mesh shape_bumpy(Random *random, Vec3 center);

// count triangles around the origin, whose rim at distance 1 waves gently: a function over the
// plane z = 0.  count is a multiple of 8.
Mesh shape_fan(uint32_t count);

// A parallelogram at corner, spanned by across and down, of cells * cells quads of two triangles.
Mesh shape_plane(Vec3 corner, Vec3 across, Vec3 down, uint32_t cells);

// The surface of the cube [-half_side, half_side]^3, each face of cells * cells quads.
Mesh shape_cube(double half_side, uint32_t cells);

// count triangles at random places of the cube [-1, 1]^3 with corners up to size from there.
Mesh shape_soup(Random *random, uint32_t count, double size);

// One triangle.
Mesh shape_triangle(Vec3 a, Vec3 b, Vec3 c);

// Adds mesh, which the scene then owns, as a two-sided object.
void shape_add(Scene *scene, Mesh mesh, uint32_t material);

// A scene of that mesh alone.
Scene shape_scene(Mesh mesh);
