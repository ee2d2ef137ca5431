// SPDX-License-Identifier: MIT
// Identifies existing files by device and inode, and new files by folder and name. Follows symbolic
// links first. Sorting makes entries of the same file adjacent, so even a million outputs are
// checked quickly.
#include "base/file_plan.h"

#include "base/file.h"
#include "base/text.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define LINKS_MOST 40 // length of a chain of links; the system's limit

static void take_identity(PlannedFile *file, const struct stat *status)
{
    file->device = (uint64_t)status->st_dev;
    file->inode = (uint64_t)status->st_ino;
}

// Returns the target of the symbolic link at `path`, as a path from the current folder. Returns
// NULL if `path` is not a link or memory runs out. The caller frees the result.
static char *read_link(const char *path, Error *error)
{
    char target[4096];
    const ssize_t length = readlink(path, target, sizeof target - 1);
    if (length < 0)
        return NULL;
    target[length] = '\0';
    return file_path_beside(path, target, error);
}

// Returns the path of the file that is created if a program writes to `path`. If `path` is a link,
// the result is the target of the last link in the chain. Otherwise, the result is a copy of
// `path`. The caller frees the result.
static char *follow_links(const char *path, Error *error)
{
    char *end = text_copy(path, error);
    for (int links = 0; end != NULL && links < LINKS_MOST; links++) {
        char *next = read_link(end, error);
        if (next == NULL)
            break;
        free(end);
        end = next;
    }
    return end;
}

// Identifies a new file. If the folder is missing, `inode` stays 0, a number that no file has.
static bool identify_new(PlannedFile *file, Error *error)
{
    struct stat status;
    char *path = follow_links(file->path, error);
    if (path == NULL)
        return false;
    file->name = text_copy(text_file_name(path), error);
    char *folder = file_path_beside(path, ".", error);
    if (folder != NULL && stat(folder, &status) == 0)
        take_identity(file, &status);
    const bool ok = file->name != NULL && folder != NULL;
    free(folder);
    free(path);
    return ok;
}

static bool stat_file(const char *path, FileUse use, struct stat *status)
{
    const int standard = use == FILE_INPUT ? STDIN_FILENO : STDOUT_FILENO;
    return (strcmp(path, "-") == 0 ? fstat(standard, status) : stat(path, status)) == 0;
}

static void free_file(PlannedFile *file)
{
    free(file->path);
    free(file->name);
}

bool file_plan_add(FilePlan *plan, FileUse use, const char *role, const char *path, Error *error)
{
    struct stat status;
    const bool exists = stat_file(path, use, &status);
    if (exists ? !S_ISREG(status.st_mode) : use == FILE_INPUT)
        return true;
    PlannedFile file = {.use = use, .role = role, .path = text_copy(path, error)};
    if (exists)
        take_identity(&file, &status);
    const bool ok = file.path != NULL && (exists || identify_new(&file, error));
    // Ignores a file in a missing folder. A later check reports that the file cannot be written.
    if (ok && file.inode != 0 && array_push(&plan->list, file, error))
        return true;
    free_file(&file);
    return ok && file.inode == 0;
}

static int compare_numbers(uint64_t a, uint64_t b)
{
    return (a > b) - (a < b);
}

// Compares files for sorting. Returns 0 only if both are the same file.
static int compare_identity(const PlannedFile *a, const PlannedFile *b)
{
    const int device = compare_numbers(a->device, b->device);
    const int inode = device != 0 ? device : compare_numbers(a->inode, b->inode);
    if (inode != 0)
        return inode;
    return strcmp(a->name != NULL ? a->name : "", b->name != NULL ? b->name : "");
}

// Orders files by identity. If several entries name the same file, inputs come before outputs.
// Inputs stay in the order in which they were added, and so do outputs.
static int compare_files(const void *one, const void *other)
{
    const PlannedFile *a = *(const PlannedFile *const *)one,
                      *b = *(const PlannedFile *const *)other;
    const int identity = compare_identity(a, b);
    if (identity != 0)
        return identity;
    return a->use != b->use ? (a->use > b->use) - (a->use < b->use) : (a > b) - (a < b);
}

static bool check_sorted(const PlannedFile *const *files, size_t count, Error *error)
{
    for (size_t i = 1; i < count; i++) {
        const PlannedFile *first = files[i - 1], *second = files[i];
        if (second->use == FILE_OUTPUT && compare_identity(first, second) == 0)
            return error_set(error, "%s%s and %s%s are the same file: choose another name",
                             second->role, second->path, first->role, first->path);
    }
    return true;
}

bool file_plan_check(const FilePlan *plan, Error *error)
{
    const size_t count = plan->list.count;
    const PlannedFile **files = memory_raw(count, sizeof *files, error);
    if (files == NULL)
        return false;
    for (size_t i = 0; i < count; i++)
        files[i] = &plan->list.data[i];
    qsort(files, count, sizeof *files, compare_files);
    const bool ok = check_sorted(files, count, error);
    free(files);
    return ok;
}

void file_plan_free(FilePlan *plan)
{
    for (size_t i = 0; i < plan->list.count; i++)
        free_file(&plan->list.data[i]);
    free(plan->list.memory);
    *plan = (FilePlan){0};
}
