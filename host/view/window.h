// SPDX-License-Identifier: MIT
// A system window with an OpenGL context, and the user's actions as events.
#pragma once

#include "base/error.h"
#include "view/state.h"

#define WINDOW_EVENTS 256

typedef struct {
    void *handle; // GLFW's
    Event events[WINDOW_EVENTS];
    int event_count;
    char *dropped;           // the path of a file; owned; NULL for none
    double mouse_x, mouse_y; // of the latest event
    bool is_touched;         // must be drawn again
} Window;

// Connects to the display; on failure the message suggests -o FILE.
bool window_connect(Error *error);
void window_disconnect(void);

// Opens a window of that size in pixels, or as large as the screen permits, and makes its context
// current.
bool window_open(Window *window, const char *title, uint32_t width, uint32_t height, Error *error);
void window_close(Window *window);

// Waits for events or window_wake, at most that many seconds.
void window_wait(Window *window, double seconds);

// Ends a wait; callable from any thread.
void window_wake(void);

// Takes the next event; returns false for none.
bool window_take_event(Window *window, Event *event);

// Returns the path of the latest dropped file, which the caller frees; NULL for none.
char *window_take_drop(Window *window);

// Returns the size in pixels; zeros while the window is minimized.
void window_measure(const Window *window, uint32_t *width, uint32_t *height);

// Returns the number of pixels per font dot for legible text.
uint32_t window_text_scale(const Window *window);

void window_set_title(Window *window, const char *title);
void window_show(Window *window); // displays the drawn frame
void window_hide(Window *window);

// Returns whether the user has closed the window.
bool window_is_closed(const Window *window);

// Returns whether the driver has lost the context, with all objects in it.
bool window_is_lost(const Window *window);
