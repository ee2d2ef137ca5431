// SPDX-License-Identifier: MIT
// Notices that files have changed, by looking at them now and then: that works for editors that
// put a new file into the place of the old one and for file systems of other machines.
#pragma once

#include "base/array.h"

#include <stdint.h>

typedef struct {
    char *path;        // of a file, or of a folder for what is in it; owned
    uint64_t accepted; // how it looked when it was last told of
    uint64_t seen;     // and last time
    bool is_stale;
} Watched;

typedef struct {
    ARRAY(Watched) files;
    uint64_t seen; // how all of them looked last time
} Watch;

// Says what is to be watched from now on: between the two, all that is still wanted is added.  What
// was watched before is compared with what was last told of it, so that no change is lost.
void watch_begin(Watch *watch);
bool watch_add(Watch *watch, const char *path, Error *error);
void watch_end(Watch *watch);

// Looks at the files; true once where they have changed and then stood still from one look to the
// next, so that none is read while it is written.
bool watch_look(Watch *watch);

void watch_free(Watch *watch);
