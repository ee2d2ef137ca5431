// SPDX-License-Identifier: MIT
// Reads whole files, because parsers need contiguous bytes.
#include "base/file.h"

#include "base/array.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

// Pipes report no size, so the buffer grows as bytes arrive.
static bool read_all(File *file, FILE *stream, size_t expected, Error *error)
{
    void *memory = NULL;
    size_t capacity = 0;
    bool ok = array_reserve(&memory, &capacity, expected + 2, 1, error);
    while (ok) {
        file->size += fread((char *)memory + file->size, 1, capacity - file->size - 1, stream);
        if (file->size < capacity - 1)
            break;
        ok = array_reserve(&memory, &capacity, capacity + 1, 1, error);
    }
    file->bytes = memory;
    if (ok)
        file->bytes[file->size] = '\0';
    return ok;
}

static bool read_stream(File *file, FILE *stream, size_t expected, const char *name, Error *error)
{
    bool ok = read_all(file, stream, expected, error);
    if (ok && ferror(stream))
        ok = error_set(error, "%s: cannot be read: %s", name, strerror(errno));
    if (!ok)
        file_free(file);
    return ok;
}

static bool cannot_open(const char *path, Error *error)
{
    return error_set(error, "%s: cannot be opened: %s", path, strerror(errno));
}

// Rejects devices, which may never end, and folders, whose read errors are less clear.
static bool check_kind(const char *path, struct stat *status, Error *error)
{
    if (stat(path, status) != 0)
        return cannot_open(path, error);
    return S_ISREG(status->st_mode) || S_ISFIFO(status->st_mode) ||
           error_set(error, "%s: cannot be read: it is not a file", path);
}

bool file_check(const char *path, Error *error)
{
    struct stat status;
    return check_kind(path, &status, error) &&
           (access(path, R_OK) == 0 || cannot_open(path, error));
}

bool file_read(File *file, const char *path, Error *error)
{
    *file = (File){0};
    struct stat status;
    if (!check_kind(path, &status, error))
        return false;
    FILE *stream = fopen(path, "rbe");
    if (stream == NULL)
        return cannot_open(path, error);
    const size_t expected = S_ISREG(status.st_mode) ? (size_t)status.st_size : 0;
    const bool ok = read_stream(file, stream, expected, path, error);
    fclose(stream);
    return ok;
}

bool file_read_stream(File *file, FILE *stream, const char *name, Error *error)
{
    *file = (File){0};
    return read_stream(file, stream, 0, name, error);
}

void file_free(File *file)
{
    free(file->bytes);
    *file = (File){0};
}

bool file_has_ending(const char *path, const char *ending)
{
    const size_t length = strlen(path), size = strlen(ending);
    return length > size && strcasecmp(path + length - size, ending) == 0;
}

char *file_path_beside(const char *beside, const char *path, Error *error)
{
    const char *slash = strrchr(beside, '/');
    const size_t folder = path[0] == '/' || slash == NULL ? 0 : (size_t)(slash - beside) + 1;
    char *joined = memory_raw(folder + strlen(path) + 1, 1, error);
    if (joined != NULL) {
        memcpy(joined, beside, folder);
        strcpy(joined + folder, path);
    }
    return joined;
}

// Returns false without /proc. The system resolves links, so the folder is that of the real file.
static bool own_folder(char folder[PATH_MAX])
{
    const ssize_t length = readlink("/proc/self/exe", folder, PATH_MAX - 1);
    if (length <= 0)
        return false;
    folder[length] = '\0';
    char *slash = strrchr(folder, '/');
    if (slash == NULL)
        return false;
    slash[slash == folder] = '\0'; // keeps the slash of the root folder
    return true;
}

bool file_companion(char path[COMPANION_PATH_SIZE], const char *name, const char *folder)
{
    char own[PATH_MAX];
    if (!own_folder(own))
        return false;
    snprintf(path, COMPANION_PATH_SIZE, "%s/%s", own, name);
    if (access(path, R_OK) != 0)
        snprintf(path, COMPANION_PATH_SIZE, "%s/%s/%s", own, folder, name);
    return true;
}
