// SPDX-License-Identifier: MIT
// Builds a program under the cache's lock. Before the build, PoCL's files for the program are
// checked against a manifest of checksums. Damaged files are removed, so that PoCL compiles again;
// with damaged files it crashes or computes wrong results.
#pragma once

#include "device/cache.h"

typedef struct {
    const Cache *cache;
    const char *key;
    char *manifest;        // NULL without an intact one; owned
    unsigned loaded_count; // kernels that the process had loaded before
    int lock;
} CacheBuild;

// Waits for the lock, and removes damaged files of the program with this key. Borrows key.
void cache_build_begin(CacheBuild *build, const Cache *cache, const char *key);

// Unlocks. If the program works, including the first run of its kernels, also writes the manifest.
void cache_build_end(CacheBuild *build, bool works);

// Returns whether a program with this key has been built, judging by its manifest alone.
bool cache_has_program(const Cache *cache, const char *key);
