// SPDX-License-Identifier: MIT
// The folder that holds compiled kernels, and the lock on it. PoCL 3.1 loses builds when several
// processes share a cold cache. PoCL lists no device if it cannot write its cache. clrt therefore
// gives PoCL a separate folder and locks the folder during each build.
#pragma once

#include "base/error.h"

#define CACHE_PATH_SIZE 512

typedef struct {
    char folder[CACHE_PATH_SIZE];  // holds the lock and manifests (manifest.h); "" if not writable
    char kernels[CACHE_PATH_SIZE]; // holds PoCL's files; "" if unknown
    bool owns_kernels;             // only clrt stores files in `kernels`
    bool temporary;                // cache_close removes `folder`
    // Called with true before a program is compiled and with false afterwards, on any thread; may
    // be NULL.
    void (*announce)(bool begins);
} Cache;

// Chooses the first of $POCL_CACHE_DIR/clrt, $XDG_CACHE_HOME/clrt, ~/.cache/clrt and a private
// temporary folder that is writable and has free space. If hosts share the file system of the
// second or third, clrt-hosts/HOST/clrt replaces clrt. Sets POCL_CACHE_DIR to a subfolder of the
// chosen folder. If no folder qualifies, PoCL lists no device. Only main may call cache_open,
// before the first OpenCL call.
void cache_open(Cache *cache);

// Opens the cache of libclrt. cache_close is unnecessary. Leaves the environment unchanged, so
// PoCL stores its kernels in POCL_CACHE_DIR or in its default folder. cache->folder is clrt/library
// in $POCL_CACHE_DIR, $XDG_CACHE_HOME or ~/.cache, or empty if no folder is writable.
void cache_open_for_library(Cache *cache);

// Removes the folder if it is temporary. No OpenCL object may be in use.
void cache_close(Cache *cache);

// Clears *cache, then creates cache->folder = `base` + `rest`. Returns false if it is not writable.
bool cache_take_folder(Cache *cache, const char *base, const char *rest);

// Removes a file or a folder with its contents, as far as possible.
void cache_remove(const char *path);

// Waits for the lock and returns its handle for cache_unlock. Returns -1 without a folder or if
// locking fails. Builds are then unprotected.
int cache_lock(const Cache *cache);
void cache_unlock(int lock);
