// SPDX-License-Identifier: MIT
// Builds a program under the cache's lock.  The files that PoCL keeps of it are checked before,
// against the checksums in a manifest, and damaged ones are removed, so that PoCL compiles again:
// it crashes on damaged files, or computes something else.
#pragma once

#include "device/cache.h"

typedef struct {
    const Cache *cache;
    const char *key;
    char *manifest;        // NULL where no whole one was found; owned
    unsigned loaded_count; // kernels that the process had loaded before
    int lock;
} CacheBuild;

// Waits for the lock, and removes what is damaged of the program with this key, which is borrowed.
void cache_build_begin(CacheBuild *build, const Cache *cache, const char *key);

// Writes the manifest if the program works, which includes the first run of its kernels, and
// unlocks.
void cache_build_end(CacheBuild *build, bool works);

// Returns whether a program with this key was built before, by its manifest alone.
bool cache_has_program(const Cache *cache, const char *key);
