// SPDX-License-Identifier: MIT
// Finds a folder that can be written and locks it with flock, which the system drops by itself
// when a process dies.  What sets the environment or removes files is cache_open.c.
#include "device/cache.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

// Makes the folder and those above it; true where it can be written.
static bool make_folder(const char *path)
{
    char part[CACHE_PATH_SIZE];
    snprintf(part, sizeof part, "%s", path);
    for (char *slash = part + 1; *slash != '\0'; slash++) {
        if (*slash != '/')
            continue;
        *slash = '\0';
        if (mkdir(part, 0700) != 0 && errno != EEXIST)
            return false;
        *slash = '/';
    }
    return (mkdir(part, 0700) == 0 || errno == EEXIST) && access(part, W_OK | X_OK) == 0;
}

static bool usable_path(char path[CACHE_PATH_SIZE], const char *base, const char *rest)
{
    if (base == NULL || base[0] != '/')
        return false;
    const int length = snprintf(path, CACHE_PATH_SIZE, "%s%s", base, rest);
    return length > 0 && length < CACHE_PATH_SIZE && make_folder(path);
}

static bool find_folder(Cache *cache, const char *under_cache, const char *under_home)
{
    *cache = (Cache){0};
    if (usable_path(cache->folder, getenv("XDG_CACHE_HOME"), under_cache) ||
        usable_path(cache->folder, getenv("HOME"), under_home))
        return true;
    cache->folder[0] = '\0';
    return false;
}

bool cache_find(Cache *cache)
{
    return find_folder(cache, "/clrt", "/.cache/clrt");
}

void cache_open_for_library(Cache *cache)
{
    if (getenv("POCL_CACHE_DIR") != NULL)
        cache_find(cache);
    else
        find_folder(cache, "/clrt/library", "/.cache/clrt/library");
}

int cache_lock(const Cache *cache)
{
    char path[CACHE_PATH_SIZE + 8];
    if (cache->folder[0] == '\0')
        return -1;
    snprintf(path, sizeof path, "%s/lock", cache->folder);
    const int lock = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (lock < 0)
        return -1;
    while (flock(lock, LOCK_EX) != 0) {
        if (errno == EINTR)
            continue;
        close(lock);
        return -1;
    }
    return lock;
}

void cache_unlock(int lock)
{
    if (lock >= 0)
        close(lock);
}

static bool key_path(const Cache *cache, const char *kind, const char *key,
                     char path[2 * CACHE_PATH_SIZE])
{
    snprintf(path, 2 * CACHE_PATH_SIZE, "%s/%s-%s", cache->folder, kind, key);
    return cache->folder[0] != '\0';
}

bool cache_has_mark(const Cache *cache, const char *key)
{
    char path[2 * CACHE_PATH_SIZE];
    return key_path(cache, "built", key, path) && access(path, F_OK) == 0;
}

void cache_set_mark(const Cache *cache, const char *key)
{
    char path[2 * CACHE_PATH_SIZE];
    if (!key_path(cache, "built", key, path))
        return;
    const int file = open(path, O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
    if (file >= 0)
        close(file);
}

// The sum is the size of a file without contents, in milliseconds: it takes no parsing, and no
// other fault than being forgotten.
double cache_lost(const Cache *cache, const char *key)
{
    char path[2 * CACHE_PATH_SIZE];
    struct stat status;
    const bool found = key_path(cache, "lost", key, path) && stat(path, &status) == 0;
    return found ? (double)status.st_size * 1e-3 : 0;
}

void cache_add_lost(const Cache *cache, const char *key, double seconds)
{
    char path[2 * CACHE_PATH_SIZE];
    if (!key_path(cache, "lost", key, path))
        return;
    const int file = open(path, O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
    if (file < 0)
        return;
    const off_t sum = lseek(file, 0, SEEK_END) + (off_t)(seconds * 1e3);
    if (ftruncate(file, sum) != 0)
        unlink(path);
    close(file);
}
