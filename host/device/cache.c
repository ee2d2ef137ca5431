// SPDX-License-Identifier: MIT
// Finds a folder that can be written and locks it with flock, which the system drops by itself
// when a process dies.
#include "device/cache.h"

#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
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

static bool temporary_path(char path[CACHE_PATH_SIZE])
{
    const char *base = getenv("TMPDIR");
    const int length = snprintf(path, CACHE_PATH_SIZE, "%s/clrt-XXXXXX",
                                base != NULL && base[0] == '/' ? base : "/tmp");
    return length > 0 && length < CACHE_PATH_SIZE && mkdtemp(path) != NULL;
}

void cache_open(Cache *cache)
{
    *cache = (Cache){0};
    if (!usable_path(cache->folder, getenv("XDG_CACHE_HOME"), "/clrt") &&
        !usable_path(cache->folder, getenv("HOME"), "/.cache/clrt")) {
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
