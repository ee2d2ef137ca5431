// SPDX-License-Identifier: MIT
// Builds PLY files for tests, and parses them with strict checks.
#pragma once

#include "mesh/ply.h"

#include "unit/cmocka_all.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define HEAD   "ply\nformat ascii 1.0\n"
#define BINARY "ply\nformat binary_big_endian 1.0\n"
#define XYZ    "property float x\nproperty float y\nproperty float z\n"
#define FACES  "element face 1\nproperty list uchar int vertex_indices\n"

// In sanitizer builds, allocations of more than a megabyte fail. No file of these tests may make
// the reader allocate that much.
const char *__asan_default_options(void);
const char *__asan_default_options(void)
{
    return "max_allocation_size_mb=1:allocator_may_return_null=1";
}

typedef struct {
    char bytes[2048];
    size_t size;
    int encoding;
} Builder;

__attribute__((format(printf, 2, 3))) static inline void put_text(Builder *builder,
                                                                  const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    builder->size += (size_t)vsnprintf(builder->bytes + builder->size,
                                       sizeof builder->bytes - builder->size, format, arguments);
    va_end(arguments);
    assert_true(builder->size < sizeof builder->bytes);
}

// Parses a copy without spare bytes, except for an empty text. Sanitizers then detect every access
// beyond the end.
static inline bool parse(Mesh *mesh, const char *bytes, size_t size, Error *error)
{
    char *copy = malloc(size + (size == 0));
    assert_non_null(copy);
    memcpy(copy, bytes, size);
    *error = (Error){0};
    const bool ok =
        ply_parse(mesh, &(PlySource){.bytes = copy, .size = size, .name = "t.ply"}, error);
    free(copy);
    const Mesh empty = {0};
    if (ok && error->text[0] != '\0')
        fail_msg("a parse that succeeded left the message '%s'", error->text);
    if (!ok && memcmp(mesh, &empty, sizeof empty) != 0)
        fail_msg("a parse that failed left a mesh: %s", error->text);
    if (strstr(error->text, "out of memory") != NULL || strchr(error->text, '\n') != NULL)
        fail_msg("unexpected: %s", error->text);
    return ok;
}

static inline Mesh parse_good(const Builder *builder)
{
    Mesh mesh;
    Error error;
    if (!parse(&mesh, builder->bytes, builder->size, &error))
        fail_msg("%s", error.text);
    return mesh;
}

static inline void assert_triangle(const Mesh *mesh, size_t triangle, uint32_t a, uint32_t b,
                                   uint32_t c)
{
    assert_int_equal(mesh->triangles[triangle][0], a);
    assert_int_equal(mesh->triangles[triangle][1], b);
    assert_int_equal(mesh->triangles[triangle][2], c);
}
