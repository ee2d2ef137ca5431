// SPDX-License-Identifier: MIT
// The meshes of the extremes. Vertices are rounded to float in the scene's coordinates, as in a
// file. Far from the origin, the rounding deforms the shape, but neighbors keep sharing vertices.
#pragma once

#include "random_points.h"
#include "scene/scene.h"

// Returns the nearest float to value. A volatile variable holds the float, because gcc 12 would
// remove a conversion to float and back.
static inline double shape_rounded(double value)
{
    const volatile float rounded = (float)value;
    return (double)rounded;
}

static inline void shape_store(float values[3], Vec3 vector)
{
    values[0] = (float)shape_rounded(vector.x);
    values[1] = (float)shape_rounded(vector.y);
    values[2] = (float)shape_rounded(vector.z);
}

// Returns a mesh whose vertices and triangles the caller fills.
Mesh shape_unfilled(size_t vertices, size_t triangles);

Vec3 shape_vertex(const Mesh *mesh, size_t vertex);

// Rounds the position to float.
void shape_set_vertex(Mesh *mesh, size_t vertex, Vec3 position);

// Reverses the orientation of all triangles.
void shape_flip(Mesh *mesh);

// Returns the mesh with the corners of each triangle in a random order.
Mesh shape_reordered(Mesh mesh, Random *random);

// Returns the center of far spheres: (s, -0.75 s, 0.5 s) for s = 2^exponent.
Vec3 shape_center(int exponent);

#define SPHERE_RADIUS 2.0

// A closed sphere of `rings` bands. A band has 2 * rings quads, or 2 * rings triangles at a pole.
Mesh shape_sphere(uint32_t rings, Vec3 center);

// A closed globe of 16 bands of 16 quads, or of 16 triangles at a pole. Its vertices are at random
// distances of 1 to 6 from center (after the bumpy sphere of pbrt's tests).
Mesh shape_bumpy(Random *random, Vec3 center);

// A fan of count triangles around the origin. Its rim, at distance 1 from the z axis, waves around
// the plane z = 0. count must be a multiple of 8.
Mesh shape_fan(uint32_t count);

// A parallelogram of cells * cells quads of two triangles, spanned by across and down.
Mesh shape_plane(Vec3 corner, Vec3 across, Vec3 down, uint32_t cells);

// The surface of the cube [-half_side, half_side]^3, each face of cells * cells quads.
Mesh shape_cube(double half_side, uint32_t cells);

// count triangles at random places of [-1, 1]^3. On each axis, a triangle's corners are within
// `size` of its place.
Mesh shape_soup(Random *random, uint32_t count, double size);

Mesh shape_triangle(Vec3 a, Vec3 b, Vec3 c);

// Returns a copy of a closed mesh, changed so that it touches itself in no vertex. If several fans
// of triangles meet in a point, all fans but the first get a vertex of their own. This vertex is a
// twentieth of the way from the point to the fan's middle. The result has no normals.
Mesh shape_apart(const Mesh *mesh);

static inline Light light_white(Vec3 position, double intensity)
{
    return (Light){position, intensity, {1, 1, 1}, false};
}

// Adds mesh as a two-sided object. The scene then owns the mesh.
void shape_add(Scene *scene, Mesh mesh, uint32_t material);

// Returns a scene of one mesh.
Scene shape_scene(Mesh mesh);
