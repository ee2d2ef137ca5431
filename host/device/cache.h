// SPDX-License-Identifier: MIT
// The cache of compiled kernels has one file for each program. The file has a checksum, because
// drivers crash or compute wrong results with damaged binaries. Files appear complete or not at
// all, so processes need no lock to read them.
//
// PoCL also keeps files of its own. PoCL 3.1 loses builds if several processes share these files.
// The executable therefore gives PoCL a private folder, and removes the folder at the end
// (cache_private.h).
#pragma once

#include "base/file.h"

#include <stdint.h>

#define CACHE_PATH_SIZE 512
#define CACHE_KEY_SIZE  33

typedef struct {
    char folder[CACHE_PATH_SIZE]; // holds KEY.bin files and possibly private folders; "" for none
    char private_folder[CACHE_PATH_SIZE]; // PoCL's files; "" if PoCL chooses its own folder
    int private_lock;  // file lock that keeps other processes from removing private_folder
    uint64_t settings; // hash of the environment variables that change what PoCL compiles
    // The thread that compiles a program calls this function with true before it compiles, and with
    // false afterwards. `announce` may be NULL.
    void (*announce)(bool begins);
} Cache;

// Chooses the first of $POCL_CACHE_DIR/clrt, $XDG_CACHE_HOME/clrt and ~/.cache/clrt that exists or
// can be created. PoCL's own files stay in POCL_CACHE_DIR or in PoCL's default folder.
void cache_open(Cache *cache);

// A program's binary in memory. `file` owns the bytes.
typedef struct {
    File file;
    const unsigned char *bytes;
    size_t size;
} CachedBinary;

// Reads the binary with the key `key` from the user's folder or from /var/cache/clrt, which
// packages fill. Returns false if neither has an intact file. The caller frees binary->file.
bool cache_read(const Cache *cache, const char *key, CachedBinary *binary);

// Writes the binary to the user's folder. If this fails, stores nothing and returns false.
bool cache_write(const Cache *cache, const char *key, const void *bytes, size_t size);

// Returns whether cache_read would find a file for `key`. The file may be damaged.
bool cache_has(const Cache *cache, const char *key);

// Waits for the lock that protects PoCL's files while a program is made. Returns the lock for
// cache_unlock, or -1 if PoCL's files are private, the cache has no folder or locking fails.
int cache_lock(const Cache *cache);
void cache_unlock(int lock);
