// SPDX-License-Identifier: MIT
// Builds a program under the cache's lock. Before the build, clrt compares PoCL's files for the
// program with a manifest of checksums. PoCL crashes or computes wrong results with damaged files,
// so clrt removes them, and PoCL compiles again.
#pragma once

#include "device/cache.h"

typedef struct {
    const Cache *cache;
    const char *key;
    char *manifest;        // lines of the intact manifest; NULL without one; owned
    unsigned loaded_count; // kernels that the process had loaded before the build
    int lock;
    bool is_announced; // cache->announce waits for the end of the build
} CacheCheck;

// Waits for the lock, and removes the program's files if some are damaged. Borrows cache and key.
void cache_check_begin(CacheCheck *build, const Cache *cache, const char *key);

// Unlocks the cache. If the program and a first run of its kernels worked, writes its manifest.
void cache_check_end(CacheCheck *build, bool works);

// Returns whether the program with this key has an intact manifest, which means that it was built.
bool cache_has_program(const Cache *cache, const char *key);
