// SPDX-License-Identifier: MIT
// Makes rays in normalized coordinates, aimed at edges and vertices of triangles.
#pragma once

#include "ray_batch.h"
#include "room.h"

// Returns uninitialized rays.
Rays rays_make(size_t count);
void rays_free(const Rays *rays);

// Returns whether ray i needs a new origin. With packets, `bundle` rays share an origin. With other
// kernels, every ray has its own origin.
bool rays_move_origin(size_t i, size_t bundle);

// The rays per origin, enough to fill packets in every octant of directions.
#define RAY_BUNDLE 512

// Returns a camera ray between two points. Rounds `from` to float, and then the direction.
TestRay ray_between(Vec3 from, Vec3 to);

// Returns the ray of ray_between for two points that are given in scene coordinates.
TestRay ray_between_in(const Stage *stage, Vec3 from, Vec3 to);

// The targets of rays that start at random points of a room.
typedef enum {
    AIM_RANDOM,
    AIM_EDGES,            // random points of random edges
    AIM_VERTICES,         // random vertices
    AIM_VERTICES_EXACTLY, // vertices that are exactly origin + direction
    AIM_KINDS
} Aim;

// Returns a random edge point or vertex.
Vec3 rays_target(Aim aim, const Triangles *triangles, Random *random);

void rays_aim(Rays rays, Aim aim, const Room *room, const Triangles *triangles, Random *random);
