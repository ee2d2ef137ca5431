// SPDX-License-Identifier: MIT
// Records of mesh/foreign_stream.h -> a stream.  Failures show when it is flushed.
#pragma once

#include "mesh/foreign_stream.h"

#include <stdio.h>

void send_bytes(FILE *stream, ForeignKind kind, const void *bytes, size_t size);

// A record of that kind whose bytes are a text, shortened where it is too long.
__attribute__((format(printf, 3, 4))) void send_text(FILE *stream, ForeignKind kind,
                                                     const char *format, ...);

// The hash of size bytes and the path of the file that they are.
void send_file(FILE *stream, const char *path, const void *bytes, size_t size);

void send_part(FILE *stream, const ForeignPart *part);
