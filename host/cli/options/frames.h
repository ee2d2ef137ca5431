// SPDX-License-Identifier: MIT
// The frames of a run and their file names. A frame is a view of the scene or a step of a
// turntable.
#pragma once

#include "base/error.h"
#include "cli/options/share.h"

#include <stdint.h>

#define FRAMES_MOST 1000000

typedef struct {
    uint32_t first, last, step; // last is 0 without --frames
    uint32_t turntable;         // steps per full turn; 0: frames are views
    Share share;                // of the frames above, until frames_complete
    bool is_film;               // one animated file instead of numbered files
    bool skips_finished;        // skip frames whose files exist, and write only whole frames
} Frames;

// Parses "A-B" or "A-B:S", a share, or both with a comma between them. Returns false if text is
// malformed, and fills error as share_parse does.
bool frames_parse(Frames *frames, const char *text, Error *error);

// Returns whether --frames or --turntable is given.
bool frames_are_many(const Frames *frames);

// Without a range, selects all steps of the turntable. Reduces first and last to the share. Fails
// if there are fewer frames than shares.
bool frames_complete(Frames *frames, Error *error);

// Returns the number of pictures.
uint32_t frames_count(const Frames *frames);

// Returns the number of the frame at position place of the sequence; place counts from 0.
uint32_t frames_at(const Frames *frames, uint32_t place);

// Returns the file name of a frame. The number with leading zeros replaces the last run of '#' in
// pattern. Without '#', a number such as ".0001" precedes the ending. The caller frees the name.
// Returns NULL if memory is exhausted.
char *frames_name(const char *pattern, uint32_t number, Error *error);
