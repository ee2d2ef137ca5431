// SPDX-License-Identifier: MIT
// The body of a PLY file as a stream of values. The same calls read ascii and binary, and every
// failure reports its position in the file.
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
    PLY_FLOAT32, // the integers precede it
    PLY_FLOAT64,
} PlyType;

typedef enum { PLY_ASCII, PLY_LITTLE_ENDIAN, PLY_BIG_ENDIAN } PlyFormat;

// A range of bytes in the file.
typedef struct {
    const char *start;
    size_t length;
} PlyWord;

typedef struct {
    const char *name;        // of the file, for messages
    const char *start, *end; // its bytes
    const char *next;        // the first byte not yet read
    const char *place;       // start of the last line or value read: failures point here
    PlyFormat format;        // PLY_ASCII throughout the header
    PlyWord element;         // being read; of length 0 in the header
    int64_t index;           // of the element being read; negative for all of them
    bool is_tolerant;        // words for non-finite numbers are read as NaN
    Error *error;
} PlyReader;

// Records "NAME:LINE: ELEMENT INDEX: " or "NAME: byte OFFSET: ELEMENT INDEX: " and the message.
// Returns false.
__attribute__((format(printf, 2, 3))) bool ply_reader_fail(const PlyReader *reader,
                                                           const char *format, ...);

// A word for messages: without control characters, and shortened if long.
typedef struct {
    char text[40];
} PlyQuote;
PlyQuote ply_reader_quote(PlyWord word);

// Returns the least bytes of a value of the type in the reader's format.
size_t ply_reader_value_size(const PlyReader *reader, PlyType type);

// Fails unless the remaining bytes can hold count items of size bytes. Call this before allocating
// or looping by a count from the file.
bool ply_reader_check_room(PlyReader *reader, int64_t count, size_t size);

// Read the next value. The second accepts integer types only.
bool ply_reader_read_number(PlyReader *reader, PlyType type, double *value);
bool ply_reader_read_integer(PlyReader *reader, PlyType type, int64_t *value);

// Skips count values. Ascii values need not be numbers.
bool ply_reader_skip_values(PlyReader *reader, PlyType type, int64_t count);

bool ply_reader_is_space(char character);
