// SPDX-License-Identifier: MIT
// Finds a writable folder and locks it with flock. The system releases this lock when a process
// dies. cache_open.c sets the environment.
#include "device/cache.h"

#include <errno.h>
#include <fcntl.h>
#include <fts.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

// Creates the folder and its parents. Returns whether the folder is writable.
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

bool cache_take_folder(Cache *cache, const char *base, const char *rest)
{
    *cache = (Cache){0};
    if (base == NULL || base[0] != '/')
        return false;
    const int length = snprintf(cache->folder, CACHE_PATH_SIZE, "%s%s", base, rest);
    if (length < CACHE_PATH_SIZE && make_folder(cache->folder))
        return true;
    cache->folder[0] = '\0';
    return false;
}

// Sets cache->kernels to POCL_CACHE_DIR or, if it is unset, to PoCL's default folder.
static void find_kernels(Cache *cache)
{
    const char *chosen = getenv("POCL_CACHE_DIR"), *user = getenv("XDG_CACHE_HOME"),
               *home = getenv("HOME");
    int length = 0;
    if (chosen != NULL)
        length = snprintf(cache->kernels, CACHE_PATH_SIZE, "%s", chosen);
    else if (user != NULL && user[0] != '\0')
        length = snprintf(cache->kernels, CACHE_PATH_SIZE, "%s/pocl/kcache", user);
    else if (home != NULL)
        length = snprintf(cache->kernels, CACHE_PATH_SIZE, "%s/.cache/pocl/kcache", home);
    if (length >= CACHE_PATH_SIZE)
        cache->kernels[0] = '\0';
}

void cache_open_for_library(Cache *cache)
{
    if (cache_take_folder(cache, getenv("POCL_CACHE_DIR"), "/clrt/library") ||
        cache_take_folder(cache, getenv("XDG_CACHE_HOME"), "/clrt/library") ||
        cache_take_folder(cache, getenv("HOME"), "/.cache/clrt/library"))
        find_kernels(cache);
}

void cache_remove(const char *path)
{
    char *const paths[] = {(char *)path, NULL};
    FTS *tree = fts_open(paths, FTS_PHYSICAL | FTS_NOCHDIR, NULL);
    if (tree == NULL)
        return;
    for (FTSENT *entry = fts_read(tree); entry != NULL; entry = fts_read(tree))
        if (entry->fts_info != FTS_D)
            remove(entry->fts_path);
    fts_close(tree);
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
