// SPDX-License-Identifier: MIT
// Notices that files have changed, by looking at them now and then: that works for editors that
// put a new file into the place of the old one and for file systems of other machines.
#pragma once

#include "base/array.h"

#include <stdint.h>

typedef struct {
    ARRAY(char *) paths;     // of files, and of folders for what is in them; owned
    uint64_t accepted, seen; // how they looked when they were last told of, and last time
    bool is_first;           // they have not been looked at
} Watch;

// Empties the watch and then adds to it.  Its files are as they should be when it first looks.
void watch_clear(Watch *watch);
bool watch_add(Watch *watch, const char *path, Error *error);

// Looks at the files; true once where they have changed since the time before and then stood
// still, so that none is read while it is written.
bool watch_look(Watch *watch);
