// SPDX-License-Identifier: MIT
// Opens the cache of the program clrt. Only this file sets POCL_CACHE_DIR.
#include "device/cache.h"

#include "base/shared_disk.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/statvfs.h>
#include <unistd.h>

// The least free space. Compilers write a few megabytes, and even a cached build writes the
// preprocessed source. LLVM ends the process if the disk is full.
#define ROOM_LEAST ((unsigned long long)16 << 20)

#define OWN_FOLDER    "/clrt"       // in the user's cache folder
#define KERNEL_FOLDER "/pocl"       // in OWN_FOLDER
#define HOSTS_FOLDER  "/clrt-hosts" // in a cache folder that hosts share

// Returns whether the folder has enough free space; true if the file system does not report it.
static bool has_room(const Cache *cache)
{
    struct statvfs disk;
    if (statvfs(cache->folder, &disk) != 0 || disk.f_blocks == 0)
        return true;
    const bool has_files = disk.f_files == 0 || disk.f_favail > 0;
    return has_files && (unsigned long long)disk.f_bavail * disk.f_frsize >= ROOM_LEAST;
}

static bool take(Cache *cache, const char *base, const char *rest)
{
    Cache kernels;
    if (!cache_take_folder(cache, base, rest) || !has_room(cache) ||
        !cache_take_folder(&kernels, cache->folder, KERNEL_FOLDER))
        return false;
    memcpy(cache->kernels, kernels.folder, sizeof cache->kernels);
    cache->owns_kernels = true;
    return true;
}

// Uses POCL_CACHE_DIR, set by the user or by an earlier cache_open in this process or its parent.
static bool take_chosen(Cache *cache)
{
    static const char own[] = OWN_FOLDER KERNEL_FOLDER;
    char base[CACHE_PATH_SIZE];
    const char *chosen = getenv("POCL_CACHE_DIR");
    size_t length = chosen != NULL ? strlen(chosen) : 0;
    if (length >= sizeof base)
        return false;
    if (length >= strlen(own) && strcmp(chosen + length - strlen(own), own) == 0)
        length -= strlen(own);
    snprintf(base, sizeof base, "%.*s", (int)length, chosen != NULL ? chosen : "");
    return take(cache, base, OWN_FOLDER);
}

// Uses the user's cache folder. If hosts share that folder, uses a subfolder for this host, because
// with a common lock only one host could compile at a time.
static bool take_users(Cache *cache, const char *base, const char *rest)
{
    Cache users;
    char host[HOST_NAME_MAX + 1],
        own[sizeof HOSTS_FOLDER "/" OWN_FOLDER + HOST_NAME_MAX] = OWN_FOLDER;
    if (!cache_take_folder(&users, base, rest))
        return false;
    if (disk_is_shared(users.folder) && gethostname(host, sizeof host) == 0)
        snprintf(own, sizeof own, HOSTS_FOLDER "/%s" OWN_FOLDER, host);
    return take(cache, users.folder, own);
}

static bool take_temporary(Cache *cache)
{
    char path[CACHE_PATH_SIZE];
    const char *base = getenv("TMPDIR");
    const int length = snprintf(path, sizeof path, "%s/clrt-XXXXXX",
                                base != NULL && base[0] == '/' ? base : "/tmp");
    if (length >= CACHE_PATH_SIZE || mkdtemp(path) == NULL)
        return false;
    const bool ok = take(cache, path, "");
    cache->temporary = true;
    if (!ok)
        cache_remove(path);
    return ok;
}

void cache_open(Cache *cache)
{
    if (!take_chosen(cache) && !take_users(cache, getenv("XDG_CACHE_HOME"), "") &&
        !take_users(cache, getenv("HOME"), "/.cache") && !take_temporary(cache))
        *cache = (Cache){0};
    // Without a usable folder, PoCL lists no device, because it cannot create /dev/null/clrt.
    setenv("POCL_CACHE_DIR", cache->folder[0] != '\0' ? cache->kernels : "/dev/null/clrt", 1);
}

void cache_close(Cache *cache)
{
    if (cache->temporary)
        cache_remove(cache->folder);
    *cache = (Cache){0};
}
