// SPDX-License-Identifier: MIT
// A camera that orbits a point, as in the course's viewer: two angles and a distance.
#pragma once

#include "scene/scene.h"

typedef struct {
    Vec3 pivot;       // the center of the orbit
    Vec3 look_at, up; // of the camera
    Vec3 axes[3];     // the last is up
    double azimuth;   // degrees below the plane perpendicular to up; negative if the eye is above
    double rotation;  // degrees around up
    double distance;  // from the eye to the pivot
    double unit;      // the length unit of steps and limits: 1 in the course
    double fov_degrees;
} Orbit;

// Returns the orbit of a camera.  The course's cameras orbit the origin, others their look_at
// point.
Orbit orbit_of(const Viewpoint *viewpoint, bool is_course);

// Returns the camera at the orbit's current position.
Viewpoint orbit_viewpoint(const Orbit *orbit);

// Apply a drag, in pixels.  The course's limits stop the motion.
void orbit_turn(Orbit *orbit, double right, double down);
void orbit_zoom(Orbit *orbit, double down);

// Moves the camera sideways: the pivot follows the pointer in a window of the course's height.
void orbit_pan(Orbit *orbit, double right, double down);

// Applies a turn of the wheel, in notches; away from the user is positive.
void orbit_wheel(Orbit *orbit, double notches);
