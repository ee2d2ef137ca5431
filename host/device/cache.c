// SPDX-License-Identifier: MIT
// Each compiled program is a file KEY.bin: a checksum, followed by the driver's binary. The key is
// a hash of everything that determines the binary (program.c). The user's folder is searched first,
// and then a folder that packages fill for all users. If a file is missing, damaged or rejected,
// clrt builds the program from source.
//
// Writing is atomic: a temporary file gets its name KEY.bin by rename. Two writers of one key store
// equivalent binaries.
//
// In the library, cache_lock protects PoCL's own files. The executable has a private folder for
// these files and needs no lock. The system releases an flock when its process dies.
#include "device/cache.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

// The following functions choose the cache's folder and hash the environment variables on which its
// keys depend.

// Creates the folder and its parents. Returns whether the folder exists.
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

// Hashes PoCL's environment variables that can change the compiled code. Skips the variables that
// choose the folder or limit the threads. The sum of the hashes does not depend on the order of the
// variables.
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

void cache_open(Cache *cache)
{
    *cache = (Cache){.settings = hash_settings()};
    if (!take_folder(cache, getenv("POCL_CACHE_DIR"), "/clrt") &&
        !take_folder(cache, getenv("XDG_CACHE_HOME"), "/clrt"))
        take_folder(cache, getenv("HOME"), "/.cache/clrt");
}

// Packages store binaries for all users here.
#define SYSTEM_FOLDER "/var/cache/clrt"

#define BINARY_PATH_SIZE (CACHE_PATH_SIZE + CACHE_KEY_SIZE + 8)

static void binary_path(char path[BINARY_PATH_SIZE], const char *folder, const char *key)
{
    snprintf(path, BINARY_PATH_SIZE, "%s/%s.bin", folder, key);
}

// The key seeds the checksum. A file that was renamed to another program's key therefore counts as
// damaged.
static uint64_t checksum_of(const char *key, const void *bytes, size_t size)
{
    return XXH3_64bits_withSeed(bytes, size, XXH3_64bits(key, strlen(key)));
}

static bool read_from(const char *folder, const char *key, CachedBinary *binary)
{
    char path[BINARY_PATH_SIZE];
    uint64_t checksum;
    Error unused = {0};
    binary_path(path, folder, key);
    if (folder[0] == '\0' || !file_read(&binary->file, path, &unused))
        return false;
    if (binary->file.size > sizeof checksum) {
        memcpy(&checksum, binary->file.bytes, sizeof checksum);
        binary->bytes = (const unsigned char *)binary->file.bytes + sizeof checksum;
        binary->size = binary->file.size - sizeof checksum;
        if (checksum == checksum_of(key, binary->bytes, binary->size))
            return true;
    }
    file_free(&binary->file);
    return false;
}

bool cache_read(const Cache *cache, const char *key, CachedBinary *binary)
{
    *binary = (CachedBinary){0};
    return read_from(cache->folder, key, binary) || read_from(SYSTEM_FOLDER, key, binary);
}

bool cache_has(const Cache *cache, const char *key)
{
    char users[BINARY_PATH_SIZE], systems[BINARY_PATH_SIZE];
    binary_path(users, cache->folder, key);
    binary_path(systems, SYSTEM_FOLDER, key);
    return (cache->folder[0] != '\0' && access(users, R_OK) == 0) || access(systems, R_OK) == 0;
}

static bool write_file(int file, const char *key, const void *bytes, size_t size)
{
    const uint64_t checksum = checksum_of(key, bytes, size);
    return write(file, &checksum, sizeof checksum) == (ssize_t)sizeof checksum &&
           write(file, bytes, size) == (ssize_t)size;
}

// The temporary file is in the private folder if that is in the cache's folder, so a killed process
// leaves nothing but the private folder.
bool cache_write(const Cache *cache, const char *key, const void *bytes, size_t size)
{
    const char *folder = cache->folder;
    const bool is_inside = strncmp(cache->private_folder, folder, strlen(folder)) == 0;
    char path[BINARY_PATH_SIZE], temporary[BINARY_PATH_SIZE];
    binary_path(path, folder, key);
    snprintf(temporary, sizeof temporary, "%s/XXXXXX", is_inside ? cache->private_folder : folder);
    const int file = folder[0] != '\0' ? mkstemp(temporary) : -1;
    if (file < 0)
        return false;
    const bool ok = write_file(file, key, bytes, size) && fchmod(file, 0644) == 0;
    if (close(file) == 0 && ok && rename(temporary, path) == 0)
        return true;
    unlink(temporary);
    return false;
}

int cache_lock(const Cache *cache)
{
    char path[CACHE_PATH_SIZE + 8];
    if (cache->folder[0] == '\0' || cache->private_folder[0] != '\0')
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
