// SPDX-License-Identifier: MIT
// Chooses the folder of the cache, and hashes the environment that its keys depend on.
#include "device/cache.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

// Creates the folder and its parents. Returns whether it exists.
static bool make_folder(const char *path)
{
    char part[CACHE_PATH_SIZE];
    struct stat status;
    snprintf(part, sizeof part, "%s", path);
    for (char *slash = strchr(part + 1, '/'); slash != NULL; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        mkdir(part, 0700);
        *slash = '/';
    }
    mkdir(part, 0700);
    return stat(part, &status) == 0 && S_ISDIR(status.st_mode);
}

static bool take_folder(Cache *cache, const char *base, const char *rest)
{
    if (base == NULL || base[0] != '/')
        return false;
    const int length = snprintf(cache->folder, CACHE_PATH_SIZE, "%s%s", base, rest);
    if (length < CACHE_PATH_SIZE && make_folder(cache->folder))
        return true;
    cache->folder[0] = '\0';
    return false;
}

// Combines hashes by addition, because the order of the variables means nothing. Leaves out the
// folder and the thread limits, which do not change the compiled code.
static uint64_t hash_settings(void)
{
    static const char *const neutral[] = {
        "POCL_CACHE_DIR=", "POCL_MAX_PTHREAD_COUNT=", "POCL_CPU_MAX_CU_COUNT="};
    uint64_t sum = 0;
    for (char **variable = environ; variable != NULL && *variable != NULL; variable++) {
        bool counts = strncmp(*variable, "POCL_", strlen("POCL_")) == 0;
        for (size_t i = 0; i < sizeof neutral / sizeof *neutral; i++)
            counts = counts && strncmp(*variable, neutral[i], strlen(neutral[i])) != 0;
        sum += counts ? XXH3_64bits(*variable, strlen(*variable)) : 0;
    }
    return sum;
}

void cache_open_for_library(Cache *cache)
{
    *cache = (Cache){.settings = hash_settings()};
    if (!take_folder(cache, getenv("POCL_CACHE_DIR"), "/clrt") &&
        !take_folder(cache, getenv("XDG_CACHE_HOME"), "/clrt"))
        take_folder(cache, getenv("HOME"), "/.cache/clrt");
}
