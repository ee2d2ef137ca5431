// SPDX-License-Identifier: MIT
// The layout of tiled OpenEXR files: a magic number and the version, the attributes, a table of the
// positions of tiles, and the tiles. ZIP compression moves a tile's even bytes before its odd
// bytes, replaces each byte by its difference from the previous one, and deflates the result.
#include "image/exr_file.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#define MAGIC           "\x76\x2f\x31\x01\x02\x02\0" // version 2, single-part, tiled
#define HEADER_SIZE_MAX 65536
#define ZIP             3
#define CHANNEL_SIZE    16 // bytes after a channel's name
#define HALF            1  // the channel type that clrt does not write

typedef struct {
    const char *name, *type, *value;
    const char *start; // of the whole attribute
    uint32_t size;     // of the value
} Attribute;

static const char *skip_text(const char *at, const char *end)
{
    const char *zero = at < end ? memchr(at, 0, (size_t)(end - at)) : NULL;
    return zero == NULL ? NULL : zero + 1;
}

// Reads the attribute at *at and advances *at past it. At the end of the header, returns false and
// sets *at to the byte after it. At a damaged attribute, returns false and sets *at to NULL.
static bool next_attribute(const char **at, const char *end, Attribute *attribute)
{
    attribute->name = attribute->start = *at;
    *at = skip_text(*at, end);
    if (*at == NULL || attribute->name[0] == '\0')
        return false;
    attribute->type = *at;
    *at = skip_text(*at, end);
    if (*at == NULL || (size_t)(end - *at) < sizeof attribute->size)
        return *at = NULL, false;
    memcpy(&attribute->size, *at, sizeof attribute->size);
    attribute->value = *at + sizeof attribute->size;
    if ((size_t)(end - attribute->value) < attribute->size)
        return *at = NULL, false;
    *at = attribute->value + attribute->size;
    return true;
}

static bool read_channels(StoredImage *head, const Attribute *attribute)
{
    const char *at = attribute->value, *end = at + attribute->size;
    while (at < end && *at != '\0') {
        const char *rest = skip_text(at, end);
        if (rest == NULL || end - rest < CHANNEL_SIZE || rest - at > STORED_NAME_SIZE ||
            head->channel_count == STORED_CHANNELS_MAX || *rest == HALF)
            return false;
        memcpy(head->names[head->channel_count++], at, (size_t)(rest - at));
        at = rest + CHANNEL_SIZE;
    }
    return head->channel_count > 0;
}

static bool read_size(StoredImage *head, const Attribute *attribute)
{
    int32_t edges[4];
    if (attribute->size != sizeof edges)
        return false;
    memcpy(edges, attribute->value, sizeof edges);
    const int64_t width = (int64_t)edges[2] - edges[0] + 1,
                  height = (int64_t)edges[3] - edges[1] + 1;
    head->width = (uint32_t)width;
    head->height = (uint32_t)height;
    return width >= 1 && width <= EXR_SIDE_MAX && height >= 1 && height <= EXR_SIDE_MAX;
}

static bool read_tile_size(ExrFile *file, const Attribute *attribute)
{
    if (attribute->size != 9 || attribute->value[8] != 0)
        return false;
    memcpy(&file->tile_width, attribute->value, sizeof file->tile_width);
    memcpy(&file->tile_height, attribute->value + 4, sizeof file->tile_height);
    return file->tile_width >= 1 && file->tile_width <= EXR_SIDE_MAX && file->tile_height >= 1 &&
           file->tile_height <= EXR_SIDE_MAX;
}

static void read_text(StoredImage *head, const Attribute *attribute)
{
    for (int kind = 0; kind < STORED_TEXTS; kind++)
        if (strcmp(attribute->name, stored_text_names[kind]) == 0)
            snprintf(head->texts[kind], STORED_TEXT_SIZE, "%.*s", (int)attribute->size,
                     attribute->value);
}

static bool read_attribute(ExrFile *file, const Attribute *attribute)
{
    if (strcmp(attribute->name, "channels") == 0)
        return read_channels(&file->head, attribute);
    if (strcmp(attribute->name, "dataWindow") == 0)
        return read_size(&file->head, attribute);
    if (strcmp(attribute->name, "tiles") == 0)
        return read_tile_size(file, attribute);
    if (strcmp(attribute->name, "compression") == 0)
        return attribute->size == 1 && attribute->value[0] == ZIP;
    if (strcmp(attribute->type, "string") == 0)
        read_text(&file->head, attribute);
    return true;
}

static bool read_header(ExrFile *file)
{
    const char *start = file->header.bytes, *at = start + sizeof MAGIC,
               *end = start + file->header.size;
    Attribute attribute;
    if (file->header.size < sizeof MAGIC || memcmp(start, MAGIC, sizeof MAGIC) != 0)
        return false;
    while (next_attribute(&at, end, &attribute))
        if (!read_attribute(file, &attribute))
            return false;
    if (at == NULL)
        return false;
    file->header.size = (size_t)(at - start);
    return file->head.channel_count > 0 && file->head.width > 0 && file->tile_width > 0;
}

bool exr_file_open(ExrFile *file, const char *path, Error *error)
{
    struct stat status;
    *file = (ExrFile){.stream = fopen(path, "rbe")};
    if (file->stream == NULL || fstat(fileno(file->stream), &status) != 0)
        return error_set(error, "%s: cannot be read: %s", path, strerror(errno));
    file->bytes = (uint64_t)status.st_size;
    file->header.bytes = memory_raw(HEADER_SIZE_MAX, 1, error);
    if (file->header.bytes == NULL)
        return false;
    file->header.size =
        S_ISREG(status.st_mode) ? fread(file->header.bytes, 1, HEADER_SIZE_MAX, file->stream) : 0;
    return read_header(file) ||
           error_set(error, "%s: cannot be read: it is no EXR file of tiles, as clrt writes it",
                     path);
}

void exr_file_close(ExrFile *file)
{
    if (file->stream != NULL)
        fclose(file->stream);
    file_free(&file->header);
    *file = (ExrFile){0};
}

bool exr_file_read(const ExrFile *file, uint64_t start, void *bytes, size_t size)
{
    return start <= file->bytes && size <= file->bytes - start &&
           pread(fileno(file->stream), bytes, size, (off_t)start) == (ssize_t)size;
}

bool exr_file_find(const ExrFile *file, uint32_t column, uint32_t row, uint64_t *start,
                   ExrTileHead *head)
{
    const uint64_t columns = ((uint64_t)file->head.width + file->tile_width - 1) / file->tile_width;
    const uint64_t place = file->header.size + 8 * (row * columns + column);
    return exr_file_read(file, place, start, sizeof *start) && *start > place &&
           exr_file_read(file, *start, head, sizeof *head) && head->column == column &&
           head->row == row && head->levels[0] == 0 && head->levels[1] == 0 && head->size > 0 &&
           head->size <= exr_tile_bytes(file, file->tile_width, file->tile_height);
}

size_t exr_tile_bytes(const ExrFile *file, uint32_t width, uint32_t height)
{
    return (size_t)width * height * file->head.channel_count * sizeof(uint32_t);
}

// Undoes ZIP's differences and its reordering of bytes.
static void join_halves(const unsigned char *packed, unsigned char *bytes, size_t size)
{
    const size_t half = (size + 1) / 2;
    unsigned char sum = 128;
    for (size_t i = 0; i < size; i++) {
        sum = (unsigned char)(sum + packed[i] - 128);
        bytes[i < half ? 2 * i : 2 * (i - half) + 1] = sum;
    }
}

bool exr_file_unpack(const ExrFile *file, uint64_t start, const ExrTileHead *head,
                     unsigned char *packed, uint32_t *values, size_t size)
{
    uLongf length = size;
    if (head->size == size)
        return exr_file_read(file, start + sizeof *head, values, size);
    if (head->size > size || !exr_file_read(file, start + sizeof *head, values, head->size) ||
        uncompress(packed, &length, (const Bytef *)values, head->size) != Z_OK || length != size)
        return false;
    join_halves(packed, (unsigned char *)values, size);
    return true;
}

static const char *find_text(const Provenance *provenance, const char *name)
{
    for (size_t i = 0; i < provenance->count; i++)
        if (strcmp(provenance->list[i].name, name) == 0)
            return provenance->list[i].value;
    return NULL;
}

static bool write_attribute(const Attribute *attribute, const char *value, uint32_t size,
                            FILE *stream)
{
    const size_t names = (size_t)(attribute->value - attribute->start) - sizeof size;
    return fwrite(attribute->start, names, 1, stream) == 1 &&
           fwrite(&size, sizeof size, 1, stream) == 1 && fwrite(value, 1, size, stream) == size;
}

// Copies an attribute to the merged file. Sets the line order to increasing, because its tiles are
// in order. Clears the date unless SOURCE_DATE_EPOCH is set.
static bool copy_attribute(const Attribute *attribute, const Provenance *provenance, FILE *stream)
{
    const char *name = attribute->name;
    const bool is_date = strcmp(name, "capDate") == 0;
    const char *text = find_text(provenance, is_date ? "DateTime" : name);
    if (strcmp(name, "lineOrder") == 0)
        return write_attribute(attribute, "", 1, stream);
    if (text != NULL || is_date)
        return write_attribute(attribute, text != NULL ? text : "",
                               text != NULL ? (uint32_t)strlen(text) : 0, stream);
    return strncmp(name, "clrt:", 5) == 0 || strcmp(name, "Software") == 0 ||
           write_attribute(attribute, attribute->value, attribute->size, stream);
}

bool exr_file_copy_header(const ExrFile *file, const Provenance *provenance, FILE *stream)
{
    const char *at = file->header.bytes + sizeof MAGIC,
               *end = file->header.bytes + file->header.size;
    Attribute attribute;
    bool ok = fwrite(MAGIC, sizeof MAGIC, 1, stream) == 1;
    while (ok && next_attribute(&at, end, &attribute))
        ok = copy_attribute(&attribute, provenance, stream);
    return ok && fputc(0, stream) == 0;
}
