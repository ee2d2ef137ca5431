// SPDX-License-Identifier: MIT
// A file's signature is a hash of its modification time, size and inode. A folder's signature is
// the sum of its files' signatures.
#include "view/watch.h"

#include "base/text.h"

#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <xxhash.h>

static uint64_t signature_of_status(const struct stat *status)
{
    const uint64_t numbers[] = {(uint64_t)status->st_mtim.tv_sec, (uint64_t)status->st_mtim.tv_nsec,
                                (uint64_t)status->st_size, (uint64_t)status->st_ino};
    return XXH3_64bits(numbers, sizeof numbers);
}

static uint64_t signature_of_folder(const char *folder)
{
    uint64_t signature = 0;
    DIR *entries = opendir(folder);
    if (entries == NULL)
        return 0;
    for (struct dirent *entry = readdir(entries); entry != NULL; entry = readdir(entries)) {
        struct stat status;
        // The sum does not depend on the order of the entries.
        if (fstatat(dirfd(entries), entry->d_name, &status, 0) == 0 && S_ISREG(status.st_mode))
            signature += signature_of_status(&status);
    }
    closedir(entries);
    return signature;
}

// Returns the signature of a file or folder. A missing file has a signature too, so creating the
// file counts as a change.
static uint64_t signature_of_path(const char *path)
{
    struct stat status;
    if (stat(path, &status) != 0)
        return 1;
    return S_ISDIR(status.st_mode) ? signature_of_folder(path) : signature_of_status(&status);
}

static const Watched *find_file(const Watch *watch, const char *path)
{
    for (size_t i = 0; i < watch->files.count; i++)
        if (strcmp(watch->files.data[i].path, path) == 0)
            return &watch->files.data[i];
    return NULL;
}

static bool add_file(Watch *watch, const char *path, const Watch *before, Error *error)
{
    const Watched *known = find_file(before, path);
    const Watched file = {.path = text_copy(path, error),
                          .accepted = known != NULL ? known->accepted : signature_of_path(path)};
    if (file.path != NULL && array_push(&watch->files, file, error))
        return true;
    free(file.path);
    return false;
}

bool watch_set(Watch *watch, const char *const *paths, size_t count, Error *error)
{
    Watch before = *watch;
    bool ok = true;
    *watch = (Watch){.seen = before.seen};
    for (size_t i = 0; ok && i < count; i++)
        ok = add_file(watch, paths[i], &before, error);
    watch_free(&before);
    return ok;
}

bool watch_poll(Watch *watch)
{
    uint64_t all = 0;
    bool differs = false;
    for (size_t i = 0; i < watch->files.count; i++) {
        Watched *file = &watch->files.data[i];
        file->seen = signature_of_path(file->path);
        const uint64_t pair[] = {all, file->seen};
        all = XXH3_64bits(pair, sizeof pair);
        differs = differs || file->seen != file->accepted;
    }
    const bool stood_still = all == watch->seen;
    watch->seen = all;
    if (!stood_still || !differs)
        return false;
    for (size_t i = 0; i < watch->files.count; i++)
        watch->files.data[i].accepted = watch->files.data[i].seen;
    return true;
}

void watch_free(Watch *watch)
{
    for (size_t i = 0; i < watch->files.count; i++)
        free(watch->files.data[i].path);
    free(watch->files.memory);
    *watch = (Watch){0};
}
