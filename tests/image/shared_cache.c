// SPDX-License-Identifier: MIT
#include "image/shared_cache.h"

#include "device/cache_private.h"

#include <stdlib.h>

static Cache cache;

static void close_cache(void)
{
    cache_private_close(&cache);
}

const Cache *shared_cache(void)
{
    static bool is_open;
    if (!is_open) {
        cache_private_open(&cache);
        atexit(close_cache);
    }
    is_open = true;
    return &cache;
}
