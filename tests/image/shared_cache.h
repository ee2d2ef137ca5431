// SPDX-License-Identifier: MIT
// The kernel cache of a test program. A process may call cache_private_open only once. The first
// call sets POCL_CACHE_DIR to a private folder, so a second call would open an empty cache there.
#pragma once

#include "device/cache.h"

// Opens the cache at the first call, which must precede all OpenCL calls. The cache is closed at
// exit.
const Cache *shared_cache(void);
