// SPDX-License-Identifier: MIT
// Keys played to the window instead of a user's, and the number of frames after which it closes.
#pragma once

#include <stdbool.h>
#include <stdint.h>

typedef struct {
    const char *keys;    // remaining keys; NULL without keys
    uint32_t quit_after; // remaining frames after the last key; 0: no limit
} Script;

// Returns whether keys or frames remain, so that the window must draw without events.
bool script_is_running(const Script *script);

// Removes and returns the next key, or 0 if none is left.
int script_take_key(Script *script);

// Counts a displayed frame after all keys are played. Returns true for the last frame.
bool script_count_frame(Script *script);
