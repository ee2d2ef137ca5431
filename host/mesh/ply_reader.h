// SPDX-License-Identifier: MIT
// The body of a PLY file as a stream of values. The same calls read ASCII and binary files, and
// every failure reports its position in the file.
#pragma once

#include "base/error.h"

#include <stddef.h>
#include <stdint.h>

typedef enum {
    PLY_INT8,
    PLY_UINT8,
    PLY_INT16,
    PLY_UINT16,
    PLY_INT32,
    PLY_UINT32,
    PLY_FLOAT32, // all types before this one are integers
    PLY_FLOAT64,
} PlyType;

typedef enum { PLY_ASCII, PLY_LITTLE_ENDIAN, PLY_BIG_ENDIAN } PlyFormat;

// A range of bytes in the file.
typedef struct {
    const char *start;
    size_t length;
} PlyWord;

typedef struct {
    const char *name;        // the file's name, for messages
    const char *start, *end; // the file's bytes
    const char *next;        // the first byte not yet read
    const char *place;       // position that failures report, usually a line's or value's start
    PlyFormat format;        // PLY_ASCII throughout the header
    PlyWord element;         // name of the element being read; empty in the header
    int64_t index;           // index of the element being read; if negative, messages omit it
    bool is_tolerant;        // accepts huge numbers, and reads words such as inf and nan as NaN
    bool is_part;            // the bytes are not a file of the user, so messages omit the position
    Error *error;
} PlyReader;

// Sets the error to "NAME:LINE: ELEMENT INDEX: MESSAGE", or to "NAME: byte OFFSET: ELEMENT INDEX:
// MESSAGE" in a binary body. Omits LINE and OFFSET if reader->is_part. Returns false.
__attribute__((format(printf, 2, 3))) bool ply_reader_fail(const PlyReader *reader,
                                                           const char *format, ...);

// A word for messages, with ? for unprintable characters. Words of more than 32 characters are
// shortened.
typedef struct {
    char text[40];
} PlyQuote;
PlyQuote ply_reader_quote(PlyWord word);

// Returns the minimum size in bytes of a value of this type in the reader's format.
size_t ply_reader_value_size(const PlyReader *reader, PlyType type);

// Fails unless `count` items of `size` bytes each fit into the rest of the file. Callers must check
// each count from the file before they allocate memory or loop.
bool ply_reader_check_room(PlyReader *reader, int64_t count, size_t size);

// Both functions read the next value. ply_reader_read_integer requires an integer type.
bool ply_reader_read_number(PlyReader *reader, PlyType type, double *value);
bool ply_reader_read_integer(PlyReader *reader, PlyType type, int64_t *value);

// Skips `count` values. In ASCII files, the skipped values may be any words.
bool ply_reader_skip_values(PlyReader *reader, PlyType type, int64_t count);

bool ply_reader_is_space(char character);

// Returns a component of a color, in [0, 1]. The largest uchar and the largest ushort stand for 1.
// Clamps floats to [0, 1] and turns NaN into zero.
float ply_reader_color(PlyType type, double value);
