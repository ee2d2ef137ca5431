// SPDX-License-Identifier: MIT
// The folder that holds compiled kernels, and the lock on it. PoCL 3.1 loses builds when processes
// with a cold cache share it, and shows no device if it cannot write one. PoCL therefore gets a
// folder of clrt's own, and each build holds a lock on it.
#pragma once

#include "base/error.h"

#define CACHE_PATH_SIZE 512

typedef struct {
    char folder[CACHE_PATH_SIZE];  // lock and manifests; empty if nothing can be stored
    char kernels[CACHE_PATH_SIZE]; // PoCL's files; empty if their place is unknown
    bool owns_kernels;             // only clrt stores files there
    bool temporary;                // cache_close removes the folder
} Cache;

// Chooses $POCL_CACHE_DIR/clrt, $XDG_CACHE_HOME/clrt or ~/.cache/clrt, or a private temporary
// folder if none of these is writable with free space. Sets POCL_CACHE_DIR to a folder in it.
// Without any free space, PoCL shows no device. Only main may call it, before the first OpenCL
// call.
void cache_open(Cache *cache);

// The cache for libraries. It leaves the environment unchanged, so PoCL stores its kernels in its
// default folder. The cache's own folder holds lock and manifests; it is empty if none is
// writable. Nothing needs closing.
void cache_open_for_library(Cache *cache);

// Removes a temporary folder. No OpenCL object may be in use.
void cache_close(Cache *cache);

// Creates the folder base/rest. Returns false, and an empty cache, if it is not writable.
bool cache_take_folder(Cache *cache, const char *base, const char *rest);

// Removes a file, or a folder with its contents, as far as possible.
void cache_remove(const char *path);

// Waits for the lock and returns its handle for cache_unlock. Returns -1 without a folder or if
// locking fails, which only loses the protection.
int cache_lock(const Cache *cache);
void cache_unlock(int lock);
