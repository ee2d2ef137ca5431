// SPDX-License-Identifier: MIT
// A camera that turns about a point, as the course's viewer moves it: two angles and a distance.
#pragma once

#include "scene/scene.h"

typedef struct {
    Vec3 pivot;       // the eye turns about it
    Vec3 look_at, up; // of the camera
    Vec3 axes[3];     // the last is up
    double azimuth;   // degrees below the plane across up: the eye is above where it is negative
    double rotation;  // degrees about up
    double distance;  // of the eye from the pivot
    double unit;      // the length that steps and limits are multiples of: 1 in the course
    double fov_degrees;
} Orbit;

// The orbit a camera is on.  The course's cameras turn about the origin, others about the point
// they look at.
Orbit orbit_of(const Viewpoint *viewpoint, bool is_course);

// The camera where the orbit is now.
Viewpoint orbit_viewpoint(const Orbit *orbit);

// What dragging by so many pixels does; past the course's limits nothing moves.
void orbit_turn(Orbit *orbit, double right, double down);
void orbit_zoom(Orbit *orbit, double down);

// What is at the pivot follows the pointer, in a window as high as the course's.
void orbit_pan(Orbit *orbit, double right, double down);

// What turning the wheel by so many notches does, away from the user being positive.
void orbit_wheel(Orbit *orbit, double notches);
