// SPDX-License-Identifier: MIT
// A window of the system with an OpenGL context, and what the user does to it as events.
#pragma once

#include "base/error.h"
#include "view/state.h"

#define WINDOW_EVENTS 256

typedef struct {
    void *handle; // GLFW's
    Event events[WINDOW_EVENTS];
    int event_count;
    char *dropped;           // the path of a file; owned, NULL where none was dropped
    double mouse_x, mouse_y; // as far as drags were told
    bool is_touched;         // it must be drawn again
} Window;

// Connects to the display; the sentence of a failure says what to do without one.
bool window_connect(Error *error);
void window_disconnect(void);

// Opens a window whose inside has so many pixels, if the screen has room for them, and makes its
// context current.
bool window_open(Window *window, const char *title, uint32_t width, uint32_t height, Error *error);
void window_close(Window *window);

// Waits for events or window_wake, so many seconds at most.
void window_wait(Window *window, double seconds);

// Ends a wait, from any thread.
void window_wake(void);

// Takes the next event; false where there is none.
bool window_take_event(Window *window, Event *event);

// The path of the file that was dropped on it last, which the caller frees; NULL where none was.
char *window_take_drop(Window *window);

// The size in pixels; zeros while it is minimised.
void window_measure(const Window *window, uint32_t *width, uint32_t *height);

// Pixels to a dot of text that is read well.
uint32_t window_text_scale(const Window *window);

void window_set_title(Window *window, const char *title);
void window_show(Window *window); // what was drawn
void window_hide(Window *window);

// Whether the user wants it closed.
bool window_is_closed(const Window *window);

// Whether the driver has lost the context, so that everything in it has to be made anew.
bool window_is_lost(const Window *window);
