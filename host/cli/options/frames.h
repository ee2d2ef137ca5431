// SPDX-License-Identifier: MIT
// The frames of one run: views of the scene, or steps of a turntable; and the names of their files.
#pragma once

#include "base/error.h"

#include <stdint.h>

#define FRAMES_MOST 1000000

typedef struct {
    uint32_t first, last, step; // last is 0 where no frames are named
    uint32_t turntable;         // steps of a whole turn; 0: frames are views
} Frames;

// Reads "A-B" or "A-B:S"; false where it is none.
bool frames_parse(Frames *frames, const char *text);

// Whether there is more than one picture to draw.
bool frames_are_many(const Frames *frames);

// Names all steps of the turntable where none are named.
void frames_complete(Frames *frames);

// How many pictures are drawn.
uint32_t frames_count(const Frames *frames);

// The number of a frame, by its place from 0.
uint32_t frames_at(const Frames *frames, uint32_t place);

// The name of a frame's file: the number, with zeros before it, in place of the last '#'s of
// pattern, or as .0001 before its ending.  The caller frees it; NULL when memory ran out.
char *frames_name(const char *pattern, uint32_t number, Error *error);
