// SPDX-License-Identifier: MIT
// The kernel cache of a test program. cache_open may be called only once in a process, because a
// second call would open an empty cache in the first call's private folder for PoCL.
#pragma once

#include "device/cache.h"

// Opens the cache at the first call, which must precede all OpenCL calls. The cache is closed at
// exit.
const Cache *shared_cache(void);
