// SPDX-License-Identifier: MIT
// The inside of a closed shape. A ray that starts strictly inside must hit the shape. Other rays
// may miss it.
#pragma once

#include "random_points.h"
#include "stage.h"

// The intersection of a cube and a ball around one center, in normalized coordinates.
typedef struct {
    Vec3 center;
    double half_side; // of the cube
    double radius;    // of the ball; a little less than the distance to the nearest triangle
    Normalization normalization;
    bool has_floats; // many points of the room have float coordinates in the scene
} Room;

// Returns the part of a cube that is proven to be inside the stage's shape. center and half_side
// describe the cube in scene coordinates. Ends the test if the shape does not wind once around
// center.
Room room_inside(const Stage *stage, Vec3 center, double half_side);

// Returns a point of the room. If room->has_floats, the point's scene coordinates are floats, so
// programs that do not normalize can represent the point exactly.
Vec3 room_point(const Room *room, Random *random);

bool room_contains(const Room *room, Vec3 point);

// Returns the distance from point to the nearest point of the triangle, in fp64.
double distance_to_triangle(const Triangles *triangles, size_t triangle, Vec3 point);
