// SPDX-License-Identifier: MIT
// Implements Assimp's interface for files. Each file is read once and kept in memory, because
// Assimp opens the model several times to guess its format. Paths in a model may name any file, but
// Assimp only gets files in the model's folder or below.
#include "foreign/files.h"

#include "base/text.h"
#include "foreign/process_limits.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

// A file that Assimp has open.
typedef struct {
    struct aiFile interface;
    size_t opened; // index in Files::opened
    size_t place;  // of the next byte to read
    Files *files;
} Reading;

static size_t folder_length(const Files *files)
{
    return (size_t)(text_file_name(files->model) - files->model);
}

// Returns whether `file` is in `folder` or in a subfolder. Neither path may contain links.
static bool is_below(const char *file, const char *folder)
{
    const size_t length = strcmp(folder, "/") == 0 ? 0 : strlen(folder);
    return strncmp(file, folder, length) == 0 && file[length] == '/';
}

// Returns whether `path` is in the model's folder or below, or does not exist. Links are resolved
// first, because the folder may contain hostile links.
static bool stays_inside(const Files *files, const char *path)
{
    char *target = realpath(path, NULL);
    if (target == NULL)
        return errno == ENOENT; // a file that does not exist is harmless
    char *name = strndup(files->model, folder_length(files));
    char *folder = name != NULL ? realpath(name, NULL) : NULL;
    const bool stays = folder != NULL && is_below(target, folder);
    free(folder);
    free(name);
    free(target);
    return stays;
}

static bool is_inside(const Files *files, const char *path)
{
    // The user chose the model, so its path may be a link to anywhere.
    if (strcmp(path, files->model) == 0)
        return true;
    const size_t folder = folder_length(files);
    if (strncmp(path, files->model, folder) != 0)
        return false;
    for (const char *part = path + folder; part != NULL;) {
        if (strncmp(part, "..", 2) == 0 && (part[2] == '/' || part[2] == '\0'))
            return false;
        part = strchr(part, '/');
        part = part != NULL ? part + 1 : NULL;
    }
    return stays_inside(files, path);
}

static bool read_regular(File *file, const char *path, Error *error)
{
    struct stat status = {0};
    // Rejects pipes and devices, because their data may never end.
    if (stat(path, &status) == 0 && !S_ISREG(status.st_mode))
        return error_set(error, "cannot be read: it is not a file");
    process_limits_allow_file((uint64_t)status.st_size);
    Error cause = {0};
    if (file_read(file, path, &cause))
        return true;
    // Removes the file's name from the message, because clrt adds it again.
    const size_t length = strlen(path);
    const bool is_named = strncmp(cause.text, path, length) == 0;
    return error_set(error, "%s", cause.text + (is_named ? length + strlen(": ") : 0));
}

static bool find_opened(const Files *files, const char *path, size_t *opened)
{
    for (*opened = 0; *opened < files->opened.count; ++*opened)
        if (strcmp(files->opened.data[*opened].path, path) == 0)
            return true;
    return false;
}

static bool open_file(Files *files, const char *path, size_t *opened, Error *error)
{
    if (find_opened(files, path, opened))
        return true;
    OpenedFile file = {.path = text_copy(path, error)};
    if (file.path != NULL && read_regular(&file.file, path, error) &&
        array_push(&files->opened, file, error))
        return true;
    free(file.path);
    file_free(&file.file);
    return false;
}

static Reading *reading_of(struct aiFile *interface)
{
    return (Reading *)(void *)interface->UserData;
}

static const File *file_of(const Reading *reading)
{
    return &reading->files->opened.data[reading->opened].file;
}

static size_t read_pieces(struct aiFile *interface, char *bytes, size_t size, size_t count)
{
    Reading *reading = reading_of(interface);
    const File *file = file_of(reading);
    const size_t left = size == 0 ? 0 : (file->size - reading->place) / size;
    const size_t pieces = count < left ? count : left;
    memcpy(bytes, file->bytes + reading->place, pieces * size);
    reading->place += pieces * size;
    return pieces;
}

static size_t write_nothing(struct aiFile *interface, const char *bytes, size_t size, size_t count)
{
    (void)interface, (void)bytes, (void)size, (void)count;
    return 0;
}

static size_t file_position(struct aiFile *interface)
{
    return reading_of(interface)->place;
}

static size_t file_size(struct aiFile *interface)
{
    return file_of(reading_of(interface))->size;
}

// Implements aiFile::SeekProc. Assimp passes negative offsets as large unsigned numbers, and their
// sum with the position wraps to the right result.
static enum aiReturn seek(struct aiFile *interface, size_t offset, enum aiOrigin origin)
{
    Reading *reading = reading_of(interface);
    const size_t size = file_of(reading)->size;
    const size_t from = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? reading->place : size;
    const size_t place = from + offset;
    if (place > size)
        return aiReturn_FAILURE;
    reading->place = place;
    return aiReturn_SUCCESS;
}

static void flush_nothing(struct aiFile *interface)
{
    (void)interface;
}

// Records a material library that Assimp cannot open. Assimp then tries other names for the same
// library, so only the first name is recorded.
static void note_missing(Files *files, const char *path)
{
    const size_t folder = folder_length(files);
    const bool has_folder = strncmp(path, files->model, folder) == 0;
    if (file_has_ending(path, ".mtl") && files->missing[0] == '\0')
        snprintf(files->missing, sizeof files->missing, "%s", path + (has_folder ? folder : 0));
}

static struct aiFile *open_reading(struct aiFileIO *interface, const char *path, const char *mode)
{
    Files *files = (Files *)(void *)interface->UserData;
    Error unused = {0};
    size_t opened;
    if (strpbrk(mode, "wa+") != NULL)
        return NULL;
    const bool inside = is_inside(files, path);
    files->outside_count += !inside;
    if (!inside || !open_file(files, path, &opened, &unused)) {
        note_missing(files, path);
        return NULL;
    }
    Reading *reading = malloc(sizeof *reading);
    if (reading == NULL)
        return NULL;
    *reading = (Reading){.interface = {.ReadProc = read_pieces,
                                       .WriteProc = write_nothing,
                                       .TellProc = file_position,
                                       .FileSizeProc = file_size,
                                       .SeekProc = seek,
                                       .FlushProc = flush_nothing,
                                       .UserData = (aiUserData)reading},
                         .opened = opened,
                         .files = files};
    return &reading->interface;
}

static void close_reading(struct aiFileIO *interface, struct aiFile *file)
{
    (void)interface;
    if (file != NULL)
        free(reading_of(file));
}

void files_init(Files *files, const char *model)
{
    *files = (Files){.interface = {.OpenProc = open_reading,
                                   .CloseProc = close_reading,
                                   .UserData = (aiUserData)files},
                     .model = model};
}

bool files_open_model(Files *files, Error *error)
{
    size_t opened;
    return open_file(files, files->model, &opened, error);
}
