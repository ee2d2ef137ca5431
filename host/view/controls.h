// SPDX-License-Identifier: MIT
// State holds the window's settings. Events change the state, and views draw it. The functions
// below need no window, device or clock, so tests can play events.
#pragma once

#include "scene/scene.h"

#include <stdio.h>

// An orbiting camera: two angles and a distance.
typedef struct {
    Viewpoint camera; // its eye is not used
    Vec3 pivot;       // the center of the orbit
    Vec3 axes[3];     // unit length; the last is up
    // The eye's angle in degrees below the plane through the pivot that is perpendicular to up. The
    // angle is negative if the eye is above this plane. The viewer of the UvA course
    // (scene/scene.c) also calls this angle azimuth.
    double azimuth;
    double rotation; // degrees around up
    double distance; // from the eye to the pivot
    double unit;     // unit of the steps and limits of distances; 1 for the six default cameras
} Orbit;

// Returns the orbit of a camera. If `is_course` is true, the camera is one of the six default
// cameras, which orbit the origin. Other cameras orbit their look_at point.
Orbit orbit_of(const Viewpoint *viewpoint, bool is_course);

// Returns the camera at the orbit's current position.
Viewpoint orbit_viewpoint(const Orbit *orbit);

// Keys are typed characters. These constants stand for keys without a character.
enum { KEY_ESCAPE = 27, KEY_LEFT = 256, KEY_RIGHT, KEY_UP, KEY_DOWN, KEY_FULL_SCREEN };

typedef enum {
    EVENT_KEY,
    EVENT_TURN, // a drag that turns the camera
    EVENT_ZOOM, // a drag that zooms
    EVENT_PAN,  // a drag that moves the camera sideways
    EVENT_WHEEL,
    EVENT_CLICK // a click on a pixel
} EventKind;

typedef struct {
    EventKind kind;
    int key;
    // The drag in screen coordinates. For EVENT_WHEEL, `down` counts notches, and notches away from
    // the user are positive. For EVENT_CLICK, (right, down) is the pixel's position from the upper
    // left corner.
    double right, down;
} Event;

// Commands, as bits of a mask. The caller of state_apply runs them.
enum {
    COMMAND_CAMERA = 1,
    COMMAND_SAVE = 2,
    COMMAND_RELOAD = 4,
    COMMAND_QUIT = 8,
    COMMAND_EXPLAIN = 16,
    COMMAND_UP = 32
};

// The properties of a scene on which the state depends.
typedef struct {
    const Viewpoint *viewpoints;
    size_t viewpoint_count;
    bool is_course;   // the viewpoints are the six default ones
    uint32_t deepest; // depth of the deepest inner nodes; 0 without a tree
} StateScene;

typedef struct {
    bool traced; // ray traced; otherwise drawn by OpenGL
    bool smooth; // anti-aliased when the camera rests
    bool uses_bvh;
    bool boxes, normals; // drawn over the picture
    bool help, text;     // the displayed overlays
    bool turning;        // the camera turns automatically
    bool full_screen;
    uint32_t box_depth; // depth of the displayed boxes; 1: the root; 0: all leaves
    int exposure;       // in half stops
    uint32_t view;      // number of the latest viewpoint, from 1
    bool moved;         // the camera has moved since `view` was selected
    Orbit orbit;
    Viewpoint camera;
} State;

// Returns `state` with text switched on, and with viewpoint state.view as its camera.
State state_begin(const StateScene *scene, State state);

// Applies an event to the state and returns the bits of the event's commands.
unsigned state_apply(State *state, const Event *event, const StateScene *scene);

// If the camera turns automatically, turns it by the angle of `seconds` seconds.
void state_advance(State *state, double seconds);

// Switches to a scene that was read again. A camera that has not moved takes its viewpoint from the
// new scene. If the new scene lacks this viewpoint, the camera takes the first one.
void state_adopt(State *state, const StateScene *scene);

// Switches to another scene and its first viewpoint.
void state_open(State *state, const StateScene *scene);

// Writes the list of keys and mouse actions, one per line. Two blanks separate each key or action
// from its meaning.
void controls_write_help(FILE *stream);

// Returns the factor by which the exposure multiplies colors.
double state_gain(const State *state);
