// SPDX-License-Identifier: MIT
// The inside of a closed shape: only a ray that starts strictly inside must meet the shape, so the
// tests prove where that is before they call anything a miss.
#pragma once

#include "random.h"
#include "stage.h"

// Points within the cube and within the ball around center, in the normalized frame.
typedef struct {
    Vec3 center;
    double half_side;
    double radius; // a little less than from center to the nearest triangle
    Normalization normalization;
    bool has_floats; // the file's coordinates have floats enough in there to choose from
} Room;

// The part of the cube around center (in the file's coordinates) that is provably inside: where the
// shape winds once around center, it does so around all that is nearer than its nearest triangle.
Room room_inside(const Stage *stage, Vec3 center, double half_side);

// A point of it; one whose file coordinates are floats, where these are fine enough, so that the
// same ray can be given to programs without a frame.
Vec3 room_point(const Room *room, Random *random);

// Whether a point of the normalized frame is one of the room's.
bool room_contains(const Room *room, Vec3 point);

// From point to the nearest point of the triangle, in fp64.
double triangle_distance_to(const float corners[3][3], Vec3 point);
