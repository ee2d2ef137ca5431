// SPDX-License-Identifier: MIT
// The folder that holds compiled kernels, and the lock on it.
// PoCL 3.1 loses builds when cold processes share a cache, and shows no device where it cannot
// write one.  So PoCL gets a folder of clrt's own, and a build holds a lock on it.
#pragma once

#include "base/error.h"

#define CACHE_PATH_SIZE 512

typedef struct {
    char folder[CACHE_PATH_SIZE];  // lock and manifests; empty where nothing can be kept
    char kernels[CACHE_PATH_SIZE]; // where PoCL keeps its files; empty where that is unknown
    bool owns_kernels;             // nobody else keeps files there
    bool temporary;                // cache_close removes the folder
} Cache;

// Chooses $POCL_CACHE_DIR/clrt, $XDG_CACHE_HOME/clrt or ~/.cache/clrt, or a private temporary
// folder where none of these can be written or has room, and sets POCL_CACHE_DIR to a folder in it.
// Where there is no room at all, PoCL shows no device.  For main alone, before the first OpenCL
// call.
void cache_open(Cache *cache);

// For libraries, which leave the environment alone, so that PoCL keeps its kernels where it would.
// The folder holds lock and manifests.  There is none where none can be written; nothing needs
// closing.
void cache_open_for_library(Cache *cache);

// Removes a temporary folder.  No OpenCL object may be in use any more.
void cache_close(Cache *cache);

// Makes the folder base/rest; false, and an empty cache, where it cannot be written.
bool cache_take_folder(Cache *cache, const char *base, const char *rest);

// Removes a file, or a folder with all that is in it, as far as that is possible.
void cache_remove(const char *path);

// Waits for the lock and returns its handle for cache_unlock; -1 where there is no folder to lock
// or it cannot be locked, which only costs the protection.
int cache_lock(const Cache *cache);
void cache_unlock(int lock);
