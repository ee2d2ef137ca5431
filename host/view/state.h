// SPDX-License-Identifier: MIT
// What the window shows, as a plain value: events change it and views draw it.  It knows no window,
// no device and no clock.
#pragma once

#include "view/orbit.h"

// Keys are characters as they are typed; those without one are these.
enum { KEY_ESCAPE = 27, KEY_LEFT = 256, KEY_RIGHT, KEY_UP, KEY_DOWN };

typedef enum {
    EVENT_KEY,
    EVENT_TURN, // the mouse was dragged to turn the scene
    EVENT_ZOOM, // or to come nearer
    EVENT_PAN,  // or to move it sideways
    EVENT_WHEEL
} EventKind;

typedef struct {
    EventKind kind;
    int key;
    double right, down; // pixels; of the wheel, notches away from the user in down
} Event;

// What an event asks for beside changing the state, as bits.
enum { COMMAND_CAMERA = 1, COMMAND_SAVE = 2, COMMAND_RELOAD = 4, COMMAND_QUIT = 8 };

// What of the scene the state depends on.
typedef struct {
    const Viewpoint *viewpoints;
    size_t viewpoint_count;
    bool is_course;  // they are the course's
    uint32_t levels; // of inner nodes; 0 while there is no tree
} StateScene;

typedef struct {
    bool traced; // by rays, not by OpenGL
    bool smooth; // anti-aliased
    bool uses_bvh;
    bool boxes, normals; // drawn over the picture
    bool help, text;     // the overlays
    bool turning;        // the camera moves by itself
    uint32_t level;      // of the boxes: 0 the leaves, else inner nodes, the root being 1
    int exposure;        // half stops
    uint32_t view;       // the viewpoint chosen last, from 1
    bool moved;          // the camera has left it
    Orbit orbit;
    Viewpoint camera;
} State;

// The state a window opens with; view counts from 1.
State state_begin(const StateScene *scene, uint32_t view, bool smooth, bool uses_bvh);

// Takes an event in and returns the commands it gives.
unsigned state_apply(State *state, const Event *event, const StateScene *scene);

// Turns by so many seconds' worth, where it turns by itself.
void state_advance(State *state, double seconds);

// Goes on with a scene that was read again: a camera that has not moved follows the file's.
void state_adopt(State *state, const StateScene *scene);

// Goes on with another scene, through its first camera.
void state_open(State *state, const StateScene *scene);

// The factor that the exposure multiplies colors by.
double state_gain(const State *state);
