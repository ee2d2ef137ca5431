// SPDX-License-Identifier: MIT
// Reads whole files, because parsers need contiguous bytes.
#include "base/file.h"

#include "base/array.h"
#include "base/text.h"

#include <errno.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

// Reads `stream` to its end, or until more than `most` bytes are read. Pipes report no size, so the
// buffer grows while bytes arrive.
static bool read_all(File *file, FILE *stream, size_t expected, size_t most, Error *error)
{
    void *memory = NULL;
    size_t capacity = 0;
    bool ok = array_reserve(&memory, &capacity, expected + 2, 1, error);
    while (ok) {
        const size_t room = capacity - file->size - 1, left = most + 1 - file->size;
        file->size += fread((char *)memory + file->size, 1, room < left ? room : left, stream);
        if (file->size < capacity - 1 || file->size > most)
            break;
        ok = array_reserve(&memory, &capacity, capacity + 1, 1, error);
    }
    file->bytes = memory;
    if (ok)
        file->bytes[file->size] = '\0';
    return ok;
}

// Fails if a file above FILE_PIPE_MOST bytes has holes. Incomplete downloads have holes, and
// hostile files may claim a large size by holes.
static bool check_holes(int file, off_t size, const char *name, Error *error)
{
    const off_t start = lseek(file, 0, SEEK_CUR);
    const off_t hole = size > (off_t)FILE_PIPE_MOST ? lseek(file, start, SEEK_HOLE) : -1;
    lseek(file, start, SEEK_SET);
    return hole < 0 || hole >= size ||
           error_set(error, "%s: cannot be read: its bytes are missing from byte %lld on", name,
                     (long long)hole);
}

static bool read_stream(File *file, FILE *stream, const char *name, Error *error)
{
    struct stat status;
    const bool is_file = fstat(fileno(stream), &status) == 0 && S_ISREG(status.st_mode);
    const size_t most = is_file ? SIZE_MAX - 1 : FILE_PIPE_MOST;
    if (is_file && !check_holes(fileno(stream), status.st_size, name, error))
        return false;
    bool ok = read_all(file, stream, is_file ? (size_t)status.st_size : 0, most, error);
    if (ok && file->size > most)
        ok = error_set(error, "%s: a pipe may hold at most %zu MiB", name, most >> 20);
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

// Rejects devices, because their data may never end. Also rejects folders, because reading one
// would fail with a less clear message.
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
    const bool ok = read_stream(file, stream, path, error);
    fclose(stream);
    return ok;
}

bool file_read_stream(File *file, FILE *stream, const char *name, Error *error)
{
    *file = (File){0};
    return read_stream(file, stream, name, error);
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
    const int folder = path[0] == '/' ? 0 : (int)(text_file_name(beside) - beside);
    return text_format(error, "%.*s%s", folder, beside, path);
}
