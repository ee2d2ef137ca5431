// SPDX-License-Identifier: MIT
// Writes records to the stream. The functions ignore failures, because the caller tests the
// stream's error state at the end.
#include "foreign/send.h"

#include "mesh/ply_write.h"

#include <stdarg.h>
#include <string.h>
#include <xxhash.h>

void send_head(FILE *stream, ForeignKind kind, uint32_t number, size_t size)
{
    const ForeignHead head = {.kind = kind, .number = number, .size = size};
    fwrite(&head, sizeof head, 1, stream);
}

void send_bytes(FILE *stream, ForeignKind kind, const void *bytes, size_t size)
{
    send_head(stream, kind, 0, size);
    fwrite(bytes, 1, size, stream);
}

void send_text(FILE *stream, ForeignKind kind, const char *format, ...)
{
    char text[1000];
    va_list values;
    va_start(values, format);
    vsnprintf(text, sizeof text, format, values);
    va_end(values);
    send_bytes(stream, kind, text, strlen(text));
}

void send_file(FILE *stream, const char *path, const void *bytes, size_t size)
{
    const XXH128_hash_t digest = XXH3_128bits(bytes, size);
    const ForeignHash hash = {{digest.low64, digest.high64}};
    send_head(stream, FOREIGN_FILE, 0, sizeof hash + strlen(path));
    fwrite(&hash, sizeof hash, 1, stream);
    fwrite(path, 1, strlen(path), stream);
}

void send_part(FILE *stream, const ForeignPart *part)
{
    send_head(stream, FOREIGN_PART, part->material, ply_write_size(&part->mesh));
    ply_write(&part->mesh, stream);
}
