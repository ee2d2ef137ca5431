// SPDX-License-Identifier: MIT
// A private folder for PoCL's files. The executable has one, but the library has none.
#pragma once

#include "device/cache.h"

// Calls cache_open, and sets POCL_CACHE_DIR to a private folder. This folder is in the cache's
// folder or, if that folder is not writable or has too little free space, in $TMPDIR or /tmp.
// Without a private folder, PoCL lists no device. Also removes private folders of processes that
// were killed. A program calls this function once, before its first OpenCL call. The library does
// not call it, because the library must not change the environment.
void cache_private_open(Cache *cache);

// Removes the private folder. No OpenCL object may be in use.
void cache_private_close(Cache *cache);
