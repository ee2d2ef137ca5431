// SPDX-License-Identifier: MIT
// Writes the records of base/foreign.h. The stream's error state shows failures.
#pragma once

#include "mesh/foreign_stream.h"

#include <stdio.h>

// Starts a record. The caller then writes the record's data, which have `size` bytes.
void send_head(FILE *stream, ForeignKind kind, uint32_t number, size_t size);

void send_bytes(FILE *stream, ForeignKind kind, const void *bytes, size_t size);

// Sends a record of this kind with a text, which is shortened if it is too long.
__attribute__((format(printf, 3, 4))) void send_text(FILE *stream, ForeignKind kind,
                                                     const char *format, ...);

// Sends the hash of a file's `size` bytes, and the file's path.
void send_file(FILE *stream, const char *path, const void *bytes, size_t size);

void send_part(FILE *stream, const ForeignPart *part);
