// SPDX-License-Identifier: MIT
// Guards the build of a program: holds the cache's lock, and first compares PoCL's files for the
// program with a manifest of checksums. PoCL crashes or computes wrong results with damaged files,
// so clrt removes the program, and PoCL compiles again.
#pragma once

#include "device/cache.h"

typedef struct {
    const Cache *cache;
    const char *key;
    char *manifest;        // lines of the intact manifest; NULL without one; owned
    unsigned loaded_count; // kernels that the process had loaded before the build
    int lock;
    bool is_announced; // cache->announce(true) was called
} CacheCheck;

// Waits for the lock. If any file of the program is damaged, removes all its files. If the program
// has no manifest and only clrt uses PoCL's folder, removes all programs that no manifest lists.
// Borrows cache and key.
void cache_check_begin(CacheCheck *build, const Cache *cache, const char *key);

// Ends the build and unlocks the cache. `works` means that the build and a first run of the kernels
// succeeded. If so, writes the program's manifest if it is missing or incomplete.
void cache_check_end(CacheCheck *build, bool works);

// Returns whether the program with this key was built before and has an intact manifest.
bool cache_has_program(const Cache *cache, const char *key);
