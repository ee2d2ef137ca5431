// SPDX-License-Identifier: MIT
// What files look like is one number: the hash of their times, sizes and places on the disk.
#include "view/watch.h"

#include <dirent.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <xxhash.h>

void watch_clear(Watch *watch)
{
    for (size_t i = 0; i < watch->paths.count; i++)
        free(watch->paths.data[i]);
    free(watch->paths.memory);
    *watch = (Watch){.is_first = true};
}

bool watch_add(Watch *watch, const char *path, Error *error)
{
    const size_t size = strlen(path) + 1;
    char *copy = memory_raw(size, 1, error);
    if (copy == NULL || !array_push(&watch->paths, copy, error)) {
        free(copy);
        return false;
    }
    memcpy(copy, path, size);
    return true;
}

// A file that is not there looks like nothing, which is a look too.
static uint64_t look_of(const struct stat *status)
{
    const uint64_t numbers[] = {(uint64_t)status->st_mtim.tv_sec, (uint64_t)status->st_mtim.tv_nsec,
                                (uint64_t)status->st_size, (uint64_t)status->st_ino};
    return XXH3_64bits(numbers, sizeof numbers);
}

static uint64_t look_inside(const char *folder)
{
    uint64_t look = 0;
    DIR *entries = opendir(folder);
    if (entries == NULL)
        return 0;
    for (struct dirent *entry = readdir(entries); entry != NULL; entry = readdir(entries)) {
        struct stat status;
        // The sum does not depend on the order, which may change.
        if (fstatat(dirfd(entries), entry->d_name, &status, 0) == 0 && S_ISREG(status.st_mode))
            look += look_of(&status);
    }
    closedir(entries);
    return look;
}

static uint64_t look_at(const char *path)
{
    struct stat status;
    if (stat(path, &status) != 0)
        return 1;
    return S_ISDIR(status.st_mode) ? look_inside(path) : look_of(&status);
}

bool watch_look(Watch *watch)
{
    uint64_t now = 0;
    for (size_t i = 0; i < watch->paths.count; i++) {
        const uint64_t pair[] = {now, look_at(watch->paths.data[i])};
        now = XXH3_64bits(pair, sizeof pair);
    }
    if (watch->is_first)
        watch->accepted = now;
    watch->is_first = false;
    const bool stood_still = now == watch->seen;
    watch->seen = now;
    if (!stood_still || now == watch->accepted)
        return false;
    watch->accepted = now;
    return true;
}
