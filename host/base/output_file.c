// SPDX-License-Identifier: MIT
// Writes a temporary file beside the final name and renames it at the end. Renaming replaces a file
// atomically for all readers, even if the process is killed.
//
// Killed runs leave temporary files. A later run that writes to the same folder removes these
// files. A run locks its own temporary files, and removes only files that it can lock. On a network
// file system, other machines may not see these locks. A temporary file's name therefore contains
// the start of the system's boot id. Files with another boot id are removed after OLD_SECONDS.
#include "base/output_file.h"

#include "base/file.h"
#include "base/text.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#define PREFIX      "clrt-"
#define NAME        PREFIX "0123456701234567" // make_file replaces the digits
#define BOOT_DIGITS 8
#define ATTEMPTS    100 // to find an unused name
#define OLD_SECONDS 86400

static bool is_replaceable(const char *path)
{
    struct stat status;
    return strcmp(path, "-") != 0 && (lstat(path, &status) != 0 || S_ISREG(status.st_mode));
}

// Stores the first digits of the boot id, which the system chooses at random when it starts. Stores
// zeros if /proc is missing.
static void read_boot(char digits[BOOT_DIGITS + 1])
{
    FILE *stream = fopen("/proc/sys/kernel/random/boot_id", "re");
    if (stream == NULL || fgets(digits, BOOT_DIGITS + 1, stream) == NULL)
        memset(digits, '0', BOOT_DIGITS);
    digits[BOOT_DIGITS] = '\0';
    if (stream != NULL)
        fclose(stream);
}

// Locks an open file. Returns false if another process has locked or removed it. Returns true on
// file systems without locks, because other runs cannot lock the file there either.
static bool take_file(int file)
{
    struct stat status;
    return (flock(file, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) &&
           fstat(file, &status) == 0 && status.st_nlink > 0;
}

// Creates and locks an empty file with an unused name. Writes the last part of the name to
// `suffix`, which points into `name`. Returns the open file, or -1 on failure. open() gives the
// file the usual permissions, while mkstemp() would make it private.
static int make_file(char *suffix, const char *name)
{
    char boot[BOOT_DIGITS + 1];
    read_boot(boot);
    for (int attempt = 0; attempt < ATTEMPTS; attempt++) {
        uint32_t number = 0;
        if (getrandom(&number, sizeof number, 0) != sizeof number)
            return -1;
        snprintf(suffix, sizeof NAME, PREFIX "%s%08x", boot, number);
        const int file = open(name, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (file >= 0 && take_file(file))
            return file;
        if (file >= 0)
            close(file);
        else if (errno != EEXIST)
            return -1;
    }
    return -1;
}

// Creates the temporary file. A file that will be renamed is in the folder of the final path. A
// file that will be copied is in the system's temporary folder.
static bool make_temporary(OutputFile *file, Error *error)
{
    const char *system = getenv("TMPDIR");
    const char *folder = system != NULL && system[0] == '/' ? system : "/tmp";
    const int length = (int)(text_file_name(file->path) - file->path);
    char *name = file->replaces ? text_format(error, "%.*s." NAME, length, file->path)
                                : text_format(error, "%s/" NAME, folder);
    file->temporary = name;
    if (name == NULL)
        return false;
    file->lock = make_file(name + strlen(name) - strlen(NAME), name);
    return file->lock >= 0 || error_set(error, "%s: cannot be written: %s",
                                        file->replaces ? file->path : name, strerror(errno));
}

static bool is_temporary(const char *name)
{
    return strlen(name) == sizeof NAME && strncmp(name, "." PREFIX, sizeof PREFIX) == 0 &&
           strspn(name + sizeof PREFIX, "0123456789abcdef") == sizeof NAME - sizeof PREFIX;
}

// Removes a temporary file unless a process has locked it, or another machine may have written to
// it lately. The function locks the file until its name is gone. A process that has created the
// file, but not locked it yet, thus notices the removal and creates another file.
static void remove_unlocked(int folder, const char *name, const char *boot)
{
    struct stat status;
    const int file = openat(folder, name, O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (file < 0)
        return;
    const bool is_own = strncmp(name + sizeof PREFIX, boot, BOOT_DIGITS) == 0;
    if (flock(file, LOCK_EX | LOCK_NB) == 0 && fstat(file, &status) == 0 &&
        (is_own || status.st_mtime < time(NULL) - OLD_SECONDS))
        unlinkat(folder, name, 0);
    close(file);
}

static void clean_folder(const char *path)
{
    char boot[BOOT_DIGITS + 1];
    read_boot(boot);
    DIR *folder = opendir(path);
    for (struct dirent *entry = NULL; folder != NULL && (entry = readdir(folder)) != NULL;)
        if (is_temporary(entry->d_name))
            remove_unlocked(dirfd(folder), entry->d_name, boot);
    if (folder != NULL)
        closedir(folder);
}

static bool check_folder(const char *path, Error *error)
{
    char *folder = file_path_beside(path, ".", error);
    const bool ok =
        folder != NULL && (access(folder, W_OK | X_OK) == 0 ||
                           error_set(error, "%s: cannot be written: %s", path, strerror(errno)));
    if (ok)
        clean_folder(folder);
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
    return strlen(text_file_name(path)) <= NAME_MAX ||
           error_set(error, "%s: cannot be written: the name is too long", path);
}

bool output_file_begin(OutputFile *file, const char *path, Error *error)
{
    *file = (OutputFile){.path = path, .replaces = is_replaceable(path)};
    if (make_temporary(file, error))
        return true;
    free(file->temporary);
    *file = (OutputFile){0};
    return false;
}

bool output_file_copy(FILE *from, FILE *to)
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
    // Removes the name before copying, so that no temporary file remains if the process is killed.
    unlink(from);
    const bool ok = source != NULL && target != NULL && output_file_copy(source, target);
    if (!ok)
        error_set(cause, "%s", strerror(errno));
    if (source != NULL)
        fclose(source);
    if (target != NULL && !standard)
        fclose(target);
    return ok;
}

// Appends the folder of a temporary file that is not beside the final path.
static void name_folder(const OutputFile *file, Error *cause)
{
    const size_t length = strlen(cause->text);
    const int folder = (int)(text_file_name(file->temporary) - file->temporary) - 1;
    if (!file->replaces)
        snprintf(cause->text + length, sizeof cause->text - length,
                 "; the temporary file was in %.*s", folder, file->temporary);
}

bool output_file_end(OutputFile *file, bool ok, Error *cause)
{
    if (!ok)
        name_folder(file, cause);
    if (ok && !file->replaces)
        ok = copy_file(file->temporary, file->path, cause);
    if (ok && file->replaces && rename(file->temporary, file->path) != 0)
        ok = error_set(cause, "%s", strerror(errno));
    if (!ok)
        unlink(file->temporary);
    close(file->lock);
    free(file->temporary);
    *file = (OutputFile){0};
    return ok;
}

// The stream is buffered, so a failure to write may be reported only by fclose.
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
