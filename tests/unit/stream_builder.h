// SPDX-License-Identifier: MIT
// Builds streams of mesh/foreign_stream.h, and parses them with strict checks.
#pragma once

#include "mesh/foreign_stream.h"

#include "unit/cmocka_all.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define TRIANGLE                                                                                   \
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"                \
    "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"       \
    "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"

typedef struct {
    char bytes[8192];
    size_t size;
} Builder;

static inline void put_bytes(Builder *builder, const void *bytes, size_t size)
{
    assert_true(builder->size + size <= sizeof builder->bytes);
    memcpy(builder->bytes + builder->size, bytes, size);
    builder->size += size;
}

static inline void put_record(Builder *builder, uint32_t kind, uint32_t number, const void *bytes,
                              size_t size)
{
    const ForeignHead head = {.kind = kind, .number = number, .size = size};
    put_bytes(builder, &head, sizeof head);
    put_bytes(builder, bytes, size);
}

static inline void put_text(Builder *builder, uint32_t kind, const char *text)
{
    put_record(builder, kind, 0, text, strlen(text));
}

static inline void put_part(Builder *builder, uint32_t material, const char *ply)
{
    put_record(builder, FOREIGN_PART, material, ply, strlen(ply));
}

static inline void put_file(Builder *builder, const char *path)
{
    const size_t length = strlen(path);
    const ForeignHead head = {.kind = FOREIGN_FILE, .size = sizeof(ForeignHash) + length};
    put_bytes(builder, &head, sizeof head);
    put_bytes(builder, "0123456789abcdef", sizeof(ForeignHash));
    put_bytes(builder, path, length);
}

// Parses a copy without spare bytes, so that sanitizers detect every access beyond the end.
static inline bool parse(ForeignModel *model, const char *bytes, size_t size, Error *error)
{
    char *copy = malloc(size + (size == 0));
    assert_non_null(copy);
    memcpy(copy, bytes, size);
    *error = (Error){0};
    const ForeignStream stream = {copy, size};
    const bool ok = foreign_stream_parse(model, stream, "m.obj", ply_parse, error);
    free(copy);
    const ForeignModel empty = {0};
    if (ok ? error->text[0] != '\0' : memcmp(model, &empty, sizeof empty) != 0)
        fail_msg("a parse that %s left '%s'", ok ? "succeeded" : "failed", error->text);
    if (!ok && (strncmp(error->text, "m.obj: ", 7) != 0 || strchr(error->text, '\n') != NULL))
        fail_msg("no sentence about the file: %s", error->text);
    return ok;
}
