// SPDX-License-Identifier: MIT
// The window's settings as a plain value: events change it and views draw it.  It depends on no
// window, device or clock.
#pragma once

#include "view/orbit.h"

// Keys are characters as typed; these are the keys without a character.
enum { KEY_ESCAPE = 27, KEY_LEFT = 256, KEY_RIGHT, KEY_UP, KEY_DOWN };

typedef enum {
    EVENT_KEY,
    EVENT_TURN, // a drag that turns the scene
    EVENT_ZOOM, // a drag that changes the distance
    EVENT_PAN,  // a drag that moves the scene sideways
    EVENT_WHEEL
} EventKind;

typedef struct {
    EventKind kind;
    int key;
    double right, down; // in pixels; for the wheel, down is in notches away from the user
} Event;

// Commands of an event beyond changes of the state, as bits.
enum { COMMAND_CAMERA = 1, COMMAND_SAVE = 2, COMMAND_RELOAD = 4, COMMAND_QUIT = 8 };

// The properties of a scene that the state depends on.
typedef struct {
    const Viewpoint *viewpoints;
    size_t viewpoint_count;
    bool is_course;  // the viewpoints are the course's
    uint32_t levels; // of inner nodes; 0 without a tree
} StateScene;

typedef struct {
    bool traced; // by rays; otherwise by OpenGL
    bool smooth; // anti-aliased
    bool uses_bvh;
    bool boxes, normals; // drawn over the picture
    bool help, text;     // the overlays
    bool turning;        // the camera turns by itself
    uint32_t level;      // of the boxes: 0 the leaves, else inner nodes, with the root at 1
    int exposure;        // half stops
    uint32_t view;       // the latest viewpoint, from 1
    bool moved;          // the camera has left that viewpoint
    Orbit orbit;
    Viewpoint camera;
} State;

// Returns the initial state; view counts from 1.
State state_begin(const StateScene *scene, uint32_t view, bool smooth, bool uses_bvh);

// Applies an event to the state and returns its commands.
unsigned state_apply(State *state, const Event *event, const StateScene *scene);

// Turns the camera by that many seconds of motion if it turns by itself.
void state_advance(State *state, double seconds);

// Switches to a scene that was read again.  A camera that has not moved follows the file's.
void state_adopt(State *state, const StateScene *scene);

// Switches to another scene, at its first camera.
void state_open(State *state, const StateScene *scene);

// Returns the factor by which the exposure multiplies colors.
double state_gain(const State *state);
