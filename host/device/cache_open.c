// SPDX-License-Identifier: MIT
// What the process that has PoCL to itself does about the cache, apart from what libraries may do.
#include "device/cache.h"

#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>

static bool temporary_path(char path[CACHE_PATH_SIZE])
{
    const char *base = getenv("TMPDIR");
    const int length = snprintf(path, CACHE_PATH_SIZE, "%s/clrt-XXXXXX",
                                base != NULL && base[0] == '/' ? base : "/tmp");
    return length > 0 && length < CACHE_PATH_SIZE && mkdtemp(path) != NULL;
}

void cache_open(Cache *cache)
{
    if (!cache_find(cache)) {
        cache->temporary = temporary_path(cache->folder);
        if (!cache->temporary)
            cache->folder[0] = '\0';
    }
    if (getenv("POCL_CACHE_DIR") != NULL || cache->folder[0] == '\0')
        return;
    char pocl[CACHE_PATH_SIZE + 8];
    snprintf(pocl, sizeof pocl, "%s/pocl", cache->folder);
    setenv("POCL_CACHE_DIR", pocl, 0);
}

static int remove_entry(const char *path, const struct stat *status, int type, struct FTW *place)
{
    (void)status, (void)type, (void)place;
    remove(path);
    return 0;
}

void cache_close(Cache *cache)
{
    if (cache->temporary)
        nftw(cache->folder, remove_entry, 16, FTW_DEPTH | FTW_PHYS);
    *cache = (Cache){0};
}
