// SPDX-License-Identifier: MIT
// Checksums are 64-bit XXH3 hashes. They detect accidents, not attacks.
#include "device/manifest.h"

#include "base/file.h"

#include <fcntl.h>
#include <fts.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <xxhash.h>

#define CHECKSUM_LENGTH 16
#define HEAD_LENGTH     (CHECKSUM_LENGTH + 1) // with the space or line end after it

bool lines_append(Lines *lines, const char *text)
{
    Error unused = {0};
    const size_t length = strlen(text);
    if (!array_reserve(&lines->memory, &lines->capacity, lines->count + length + 1, 1, &unused))
        return false;
    memcpy(lines->data + lines->count, text, length + 1);
    lines->count += length;
    return true;
}

static void write_checksum(char text[CHECKSUM_LENGTH + 1], const void *bytes, size_t size)
{
    snprintf(text, CHECKSUM_LENGTH + 1, "%016llx", (unsigned long long)XXH3_64bits(bytes, size));
}

static bool has_checksum(const char *text, const void *bytes, size_t size)
{
    char right[CHECKSUM_LENGTH + 1];
    write_checksum(right, bytes, size);
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

static bool list_file(Lines *lines, const char *path, const char *name)
{
    char head[HEAD_LENGTH + 1];
    File file;
    Error unused = {0};
    if (!file_read(&file, path, &unused))
        return false;
    write_checksum(head, file.bytes, file.size);
    file_free(&file);
    head[CHECKSUM_LENGTH] = ' ';
    head[HEAD_LENGTH] = '\0';
    return lines_append(lines, head) && lines_append(lines, name) && lines_append(lines, "\n");
}

bool manifest_list(Lines *lines, const char *folder, const char *program)
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

static bool write_text(int file, const char *text)
{
    return write(file, text, strlen(text)) == (ssize_t)strlen(text);
}

void manifest_write(const char *path, const char *lines)
{
    char head[HEAD_LENGTH + 1];
    const int file = open(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    if (file < 0)
        return;
    write_checksum(head, lines, strlen(lines));
    head[CHECKSUM_LENGTH] = '\n';
    head[HEAD_LENGTH] = '\0';
    const bool ok = write_text(file, head) && write_text(file, lines);
    if (close(file) != 0 || !ok)
        unlink(path);
}
