// SPDX-License-Identifier: MIT
// Checksums are 64-bit XXH3 hashes. They detect accidents, not attacks.
#include "device/manifest.h"

#include "base/file.h"

#include <fts.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <xxhash.h>

#define CHECKSUM_LENGTH 16
#define HEAD_LENGTH     (CHECKSUM_LENGTH + 1) // with the space or line end after it

static unsigned long long checksum_of(const void *bytes, size_t size)
{
    return XXH3_64bits(bytes, size);
}

static bool has_checksum(const char *text, const void *bytes, size_t size)
{
    char right[HEAD_LENGTH];
    snprintf(right, sizeof right, "%016llx", checksum_of(bytes, size));
    return strncmp(text, right, CHECKSUM_LENGTH) == 0;
}

char *manifest_read(const char *path)
{
    File file;
    Error unused = {0};
    if (!file_read(&file, path, &unused))
        return NULL;
    char *lines = NULL;
    if (file.size >= HEAD_LENGTH &&
        has_checksum(file.bytes, file.bytes + HEAD_LENGTH, file.size - HEAD_LENGTH))
        lines = strdup(file.bytes + HEAD_LENGTH);
    file_free(&file);
    return lines;
}

static bool holds(const char *line, size_t length, const char *folder)
{
    char path[2 * MANIFEST_PATH_SIZE];
    File file;
    Error unused = {0};
    if (length <= HEAD_LENGTH || length > MANIFEST_PATH_SIZE)
        return false;
    snprintf(path, sizeof path, "%s/%.*s", folder, (int)(length - HEAD_LENGTH), line + HEAD_LENGTH);
    if (!file_read(&file, path, &unused))
        return false;
    const bool ok = has_checksum(line, file.bytes, file.size);
    file_free(&file);
    return ok;
}

bool manifest_holds(const char *lines, const char *folder)
{
    for (const char *line = lines; *line != '\0'; line += strcspn(line, "\n") + 1)
        if (!holds(line, strcspn(line, "\n"), folder))
            return false;
    return true;
}

static bool list_file(FILE *lines, const char *path, const char *name)
{
    File file;
    Error unused = {0};
    if (!file_read(&file, path, &unused))
        return false;
    fprintf(lines, "%016llx %s\n", checksum_of(file.bytes, file.size), name);
    file_free(&file);
    return true;
}

bool manifest_list(FILE *lines, const char *folder, const char *program)
{
    char path[2 * MANIFEST_PATH_SIZE];
    snprintf(path, sizeof path, "%s/%s", folder, program);
    char *const paths[] = {path, NULL};
    FTS *tree = fts_open(paths, FTS_PHYSICAL | FTS_NOCHDIR, NULL);
    bool ok = tree != NULL;
    for (FTSENT *entry = ok ? fts_read(tree) : NULL; ok && entry != NULL; entry = fts_read(tree))
        if (entry->fts_info == FTS_F)
            ok = list_file(lines, entry->fts_path, entry->fts_path + strlen(folder) + 1);
    if (tree != NULL)
        fts_close(tree);
    return ok;
}

void manifest_write(const char *path, const char *lines)
{
    FILE *stream = fopen(path, "we");
    if (stream == NULL)
        return;
    const bool ok = fprintf(stream, "%016llx\n%s", checksum_of(lines, strlen(lines)), lines) > 0;
    if (fclose(stream) != 0 || !ok)
        unlink(path);
}
