// SPDX-License-Identifier: MIT
// Renaming replaces a file atomically for all readers, even if the process is killed.
#include "base/output_file.h"

#include "base/array.h"
#include "base/file.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#define SUFFIX_SIZE sizeof "clrt-01234567"
#define ATTEMPTS    100 // to find an unused name

static bool is_replaceable(const char *path)
{
    struct stat status;
    return strcmp(path, "-") != 0 && (lstat(path, &status) != 0 || S_ISREG(status.st_mode));
}

// Creates an empty file with an unused name. suffix points into name and receives the name's random
// end. open gives the file the permissions of other new files; mkstemp would make it private.
static bool make_file(char *suffix, const char *name)
{
    for (int attempt = 0; attempt < ATTEMPTS; attempt++) {
        uint32_t number = 0;
        if (getrandom(&number, sizeof number, 0) != sizeof number)
            return false;
        snprintf(suffix, SUFFIX_SIZE, "clrt-%08x", number);
        const int file = open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (file >= 0)
            return close(file) == 0;
        if (errno != EEXIST)
            return false;
    }
    return false;
}

// Creates a temporary file: if `beside`, in the folder of path, so that it can be renamed,
// otherwise in the system's temporary folder. Returns its path, which the caller frees, or NULL.
static char *temporary_file(const char *path, bool beside, Error *error)
{
    const char *slash = strrchr(path, '/');
    const char *system = getenv("TMPDIR");
    const char *folder = system != NULL && system[0] == '/' ? system : "/tmp";
    const size_t length = slash == NULL ? 0 : (size_t)(slash - path) + 1;
    const size_t size = strlen(path) + strlen(folder) + SUFFIX_SIZE + 2;
    char *name = memory_raw(size, 1, error);
    if (name == NULL)
        return NULL;
    const int start = beside ? snprintf(name, size, "%.*s.", (int)length, path)
                             : snprintf(name, size, "%s/", folder);
    if (make_file(name + start, name))
        return name;
    error_set(error, "%s: cannot be written: %s", path, strerror(errno));
    free(name);
    return NULL;
}

static bool check_folder(const char *path, Error *error)
{
    char *folder = file_path_beside(path, ".", error);
    const bool ok =
        folder != NULL && (access(folder, W_OK | X_OK) == 0 ||
                           error_set(error, "%s: cannot be written: %s", path, strerror(errno)));
    free(folder);
    return ok;
}

bool output_file_check(const char *path, Error *error)
{
    struct stat status;
    const bool exists = stat(path, &status) == 0;
    if (path[strlen(path) - 1] == '/' || (exists && S_ISDIR(status.st_mode)))
        return error_set(error, "%s: cannot be written: it is a folder", path);
    if (!is_replaceable(path)) {
        const bool writable = strcmp(path, "-") == 0 || access(path, W_OK) == 0;
        return writable || error_set(error, "%s: cannot be written: %s", path, strerror(errno));
    }
    if (!check_folder(path, error))
        return false;
    return strlen(strrchr(path, '/') != NULL ? strrchr(path, '/') + 1 : path) <= NAME_MAX ||
           error_set(error, "%s: cannot be written: the name is too long", path);
}

bool output_file_begin(OutputFile *file, const char *path, Error *error)
{
    *file = (OutputFile){.path = path, .replaces = is_replaceable(path)};
    file->temporary = temporary_file(path, file->replaces, error);
    return file->temporary != NULL;
}

bool stream_copy(FILE *from, FILE *to)
{
    char block[65536];
    size_t count;
    while ((count = fread(block, 1, sizeof block, from)) > 0)
        if (fwrite(block, 1, count, to) != count)
            return false;
    return !ferror(from) && fflush(to) == 0;
}

static bool copy_file(const char *from, const char *path, Error *cause)
{
    const bool standard = strcmp(path, "-") == 0;
    FILE *source = fopen(from, "rb");
    FILE *target = standard ? stdout : fopen(path, "wb");
    // Removes the name before copying, so that nothing remains if the process ends here.
    unlink(from);
    const bool ok = source != NULL && target != NULL && stream_copy(source, target);
    if (!ok)
        error_set(cause, "%s", strerror(errno));
    if (source != NULL)
        fclose(source);
    if (target != NULL && !standard)
        fclose(target);
    return ok;
}

bool output_file_end(OutputFile *file, bool ok, Error *cause)
{
    if (ok && !file->replaces)
        ok = copy_file(file->temporary, file->path, cause);
    if (ok && file->replaces && rename(file->temporary, file->path) != 0)
        ok = error_set(cause, "%s", strerror(errno));
    if (!ok)
        unlink(file->temporary);
    free(file->temporary);
    *file = (OutputFile){0};
    return ok;
}

// The stream is buffered, so fclose may report the failure.
bool output_file_write(const char *path, WriteStream *write, void *context, Error *error)
{
    OutputFile file;
    Error cause = {0};
    if (!output_file_begin(&file, path, error))
        return false;
    FILE *stream = fopen(file.temporary, "wbe");
    bool ok = stream != NULL && write(context, stream, &cause);
    if (!ok)
        error_set(&cause, "%s", strerror(errno));
    if (stream != NULL && fclose(stream) != 0)
        ok = error_set(&cause, "%s", strerror(errno));
    return output_file_end(&file, ok, &cause) ||
           error_set(error, "%s: cannot be written: %s", path, cause.text);
}
