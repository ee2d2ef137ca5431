// SPDX-License-Identifier: MIT
// Where compiled kernels are kept, and the lock that keeps processes from breaking each other's.
// PoCL 3.1 loses builds when cold processes share a cache and shows no device where it cannot
// write one; so it gets a folder of clrt's own, and a build holds a lock on it.
#pragma once

#include "base/error.h"

#define CACHE_PATH_SIZE 512

typedef struct {
    char folder[CACHE_PATH_SIZE]; // empty where nothing can be kept
    bool temporary;               // the folder is this process's and goes with it
} Cache;

// Chooses $XDG_CACHE_HOME/clrt or ~/.cache/clrt, or a private temporary folder where that cannot
// be written, and tells PoCL of it unless the user has chosen already.  For main alone: it sets
// the environment, and must run before the first OpenCL call.
void cache_open(Cache *cache);

// Chooses one of the first two alone, and leaves it at that; false where neither can be written.
bool cache_find(Cache *cache);

// For libraries, which leave the environment alone, so that PoCL keeps its kernels where it would.
// The folder is one of its own, unless POCL_CACHE_DIR is set and thus clrt's kernels are the
// library's too.  There is none where none can be written; nothing needs closing.
void cache_open_for_library(Cache *cache);

// Removes a temporary folder.  No OpenCL object may be in use any more.
void cache_close(Cache *cache);

// Waits for the lock and returns its handle for cache_unlock; -1 where there is no folder to lock
// or it cannot be locked, which only costs the protection.
int cache_lock(const Cache *cache);
void cache_unlock(int lock);

// A note, kept in the folder, that a program with this key was compiled there before.
bool cache_has_mark(const Cache *cache, const char *key);
void cache_set_mark(const Cache *cache, const char *key);

// A sum, kept in the folder, of the seconds lost for want of the program with this key.
double cache_lost(const Cache *cache, const char *key);
void cache_add_lost(const Cache *cache, const char *key, double seconds);
