// SPDX-License-Identifier: MIT
// Detects changed files by polling. Unlike inotify, polling also works on network file systems and
// with editors that replace files.
#pragma once

#include "base/array.h"

#include <stdint.h>

typedef struct {
    char *path;        // path of a file, or of a folder whose files are watched; owned
    uint64_t accepted; // signature (see watch.c) at the latest reported change or, before any
                       // change, at the start
    uint64_t seen;     // the latest signature
} Watched;

typedef struct {
    ARRAY(Watched) files;
    uint64_t seen; // hash of the latest signatures
} Watch;

// Replaces the set of watched files. Files that were watched before keep their accepted signatures,
// so no change is lost.
bool watch_set(Watch *watch, const char *const *paths, size_t count, Error *error);

// Checks the files and returns whether they have changed. Reports a change only after two checks
// with equal signatures, so that no half-written file is read.
bool watch_poll(Watch *watch);

void watch_free(Watch *watch);
