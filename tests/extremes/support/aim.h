// SPDX-License-Identifier: MIT
// Makes rays in the normalized frame.
#pragma once

#include "ray_batch.h"
#include "room.h"

// Whether ray i is to start at another origin than the one before: for packets, which are of camera
// or shadow rays from one point, only after so many rays, else always.
bool aim_moves_origin(size_t i, size_t packet_rays);

// So many rays from one point lead everywhere and still fill packets.
#define AIM_BUNDLE 512

// A corner of a triangle.
Vec3 aim_corner(const Triangles *triangles, size_t triangle, size_t corner);

// A camera ray between two points, each rounded to float; the direction is rounded from the
// difference of the rounded origin and the target.
TestRay aim_at(Vec3 origin, Vec3 target);

// From random points of the room in random directions.
void aim_randomly(TestRay *rays, size_t count, const Room *room, Random *random);

// From random points of the room at random points of random edges.
void aim_at_edges(TestRay *rays, size_t count, const Room *room, const Triangles *triangles,
                  Random *random);

// From random points of the room at random vertices.
void aim_at_vertices(TestRay *rays, size_t count, const Room *room, const Triangles *triangles,
                     Random *random);

// The same without any rounding: origin + direction is the vertex.
void aim_exactly_at_vertices(TestRay *rays, size_t count, const Room *room,
                             const Triangles *triangles, Random *random);

// Room for count rays; the caller frees it.
TestRay *aim_make_rays(size_t count);
