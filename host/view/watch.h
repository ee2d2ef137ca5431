// SPDX-License-Identifier: MIT
// Detects changed files by polling, which also works for editors that replace files and for network
// file systems.
#pragma once

#include "base/array.h"

#include <stdint.h>

typedef struct {
    char *path;        // path of a file, or of a folder whose files are watched; owned
    uint64_t accepted; // the signature at the latest reported change
    uint64_t seen;     // the latest signature
    bool is_stale;
} Watched;

typedef struct {
    ARRAY(Watched) files;
    uint64_t seen; // hash of the latest signatures
} Watch;

// Replace the set of watched files. The caller calls watch_begin, adds all files again, and calls
// watch_end, which removes all other files. Known files keep their reported signatures, so no
// change is lost.
void watch_begin(Watch *watch);
bool watch_add(Watch *watch, const char *path, Error *error);
void watch_end(Watch *watch);

// Checks the files. Returns true if they have changed and then stayed the same between two checks,
// so that no half-written file is read.
bool watch_look(Watch *watch);

void watch_free(Watch *watch);
