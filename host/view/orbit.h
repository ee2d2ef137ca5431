// SPDX-License-Identifier: MIT
// A camera that orbits a point, as in the course's viewer: two angles and a distance.
#pragma once

#include "scene/scene.h"

typedef struct {
    Vec3 pivot;       // the center of the orbit
    Vec3 look_at, up; // of the camera that orbits
    Vec3 axes[3];     // unit length; the last is up
    double azimuth;   // degrees below the plane perpendicular to up; negative if the eye is above
    double rotation;  // degrees around up
    double distance;  // from the eye to the pivot
    double unit;      // length unit of steps and limits; 1 for the course's cameras
    double fov_degrees, width_degrees;
} Orbit;

// Returns the orbit of a camera. The course's cameras orbit the origin. Other cameras orbit their
// look_at point.
Orbit orbit_of(const Viewpoint *viewpoint, bool is_course);

// Returns the camera at the orbit's current position.
Viewpoint orbit_viewpoint(const Orbit *orbit);

// Apply a mouse drag in pixels, within the course's limits.
void orbit_turn(Orbit *orbit, double right, double down);
void orbit_zoom(Orbit *orbit, double down);

// Moves camera and pivot sideways by a mouse drag in pixels. The pivot follows the pointer if the
// window has the course's height.
void orbit_pan(Orbit *orbit, double right, double down);

// Zooms by notches of the mouse wheel. Positive notches, away from the user, zoom in.
void orbit_wheel(Orbit *orbit, double notches);
