// SPDX-License-Identifier: MIT
// Keys that are played to the window in place of a user, and the frames after which it closes.
#pragma once

#include <stdbool.h>
#include <stdint.h>

typedef struct {
    const char *keys;    // that are left, NULL where there were none
    uint32_t quit_after; // frames that are left once the keys are played; 0: for ever
} Script;

// Whether anything is left to play or to count, so that the window draws without being asked.
bool script_is_running(const Script *script);

// Takes the next key, 0 where there is none.
int script_take_key(Script *script);

// A frame was shown with all keys in effect; true once it was the last.
bool script_count_frame(Script *script);
