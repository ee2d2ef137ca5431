// SPDX-License-Identifier: MIT
// A system window with an OpenGL context, and the user's actions as events.
#pragma once

#include "base/error.h"
#include "view/controls.h"

#define GLFW_INCLUDE_NONE // epoxy declares OpenGL
#include <GLFW/glfw3.h>

#define WINDOW_EVENTS 256

typedef struct {
    GLFWwindow *handle;
    Event events[WINDOW_EVENTS]; // the user's actions, added by GLFW's callbacks
    int event_count;             // the caller resets this count
    char *dropped;               // path of the latest dropped file, or NULL; owned
    double mouse_x, mouse_y;     // pointer position, without small motions during a click
    int modifiers;               // GLFW's modifier bits at the latest button event
    bool may_click;              // the left button is pressed, and the pointer has hardly moved
    bool is_repeating;           // the latest key event is a repeat of a held key
    bool is_touched;             // the window must be drawn again
    bool is_full_screen;
    int place[4]; // position and size outside full screen
} Window;

// Connects to the display. On failure, the message suggests -o FILE.
bool window_connect(Error *error);

// Opens a window of this size in screen coordinates, or as large as the screen permits. Makes the
// window's context current.
bool window_open(Window *window, const char *title, uint32_t width, uint32_t height, Error *error);
void window_close(Window *window);

// Stores the window's size in pixels, or zeros while the window is minimized.
void window_measure(const Window *window, uint32_t *width, uint32_t *height);

// Returns the screen's density in pixels per 1/96 inch, at least 1.
float window_density(const Window *window);

// Switches to full screen on the primary monitor, or back.
void window_set_full_screen(Window *window, bool is_full_screen);

// Returns whether the driver has lost the context and its objects.
bool window_is_lost(const Window *window);
