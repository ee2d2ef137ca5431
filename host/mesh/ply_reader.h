// SPDX-License-Identifier: MIT
// The body of a PLY file as a stream of values. The same calls read ASCII and binary files, and
// every failure reports its position in the file.
#pragma once

#include "base/array.h"
#include "base/error.h"
#include "base/limits.h"
#include "mesh/mesh.h"

#include <stddef.h>
#include <stdint.h>

typedef enum {
    PLY_INT8,
    PLY_UINT8,
    PLY_INT16,
    PLY_UINT16,
    PLY_INT32,
    PLY_UINT32,
    PLY_FLOAT32, // all integer types precede this
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
    bool is_tolerant;        // accepts bad numbers; reads words such as inf and nan as NaN
    Error *error;
} PlyReader;

// Sets the error to "NAME:LINE: ELEMENT INDEX: MESSAGE", or to "NAME: byte OFFSET: ELEMENT INDEX:
// MESSAGE" in a binary body. Returns false.
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

// Fails unless `count` items of `size` bytes each fit into the rest of the file. Callers check a
// count from the file before they allocate memory or loop.
bool ply_reader_check_room(PlyReader *reader, int64_t count, size_t size);

// Read the next value. ply_reader_read_integer accepts only integer types.
bool ply_reader_read_number(PlyReader *reader, PlyType type, double *value);
bool ply_reader_read_integer(PlyReader *reader, PlyType type, int64_t *value);

// Skips `count` values. ASCII values need not be numbers.
bool ply_reader_skip_values(PlyReader *reader, PlyType type, int64_t count);

bool ply_reader_is_space(char character);

// Returns a component of a color, in [0, 1]. The largest integer of the type stands for 1. Clamps
// other numbers; NaN becomes zero.
float ply_reader_color(PlyType type, double value);

// The header of a PLY file: its elements, their counts, and each property's role in a Mesh.

#define PLY_COUNT_LIMIT      MESH_COUNT_MOST
#define PLY_COORDINATE_BOUND COORDINATE_MOST

// A property's role in the mesh: a vertex component, the corners of a face or of strips, or none.
typedef enum {
    PLY_X,
    PLY_Y,
    PLY_Z,
    PLY_NORMAL_X,
    PLY_NORMAL_Y,
    PLY_NORMAL_Z,
    PLY_RED,
    PLY_GREEN,
    PLY_BLUE,
    PLY_CORNERS,
    PLY_UNUSED,
} PlyRole;

typedef struct {
    PlyRole role;
    PlyType type; // type of the value, or of the list's items
    bool is_list;
    PlyType length_type; // an integer type; only for lists
} PlyProperty;

typedef enum { PLY_VERTEX, PLY_FACE, PLY_STRIPS, PLY_OTHER } PlyKind;

typedef struct {
    PlyWord name;
    PlyKind kind;
    unsigned roles; // bit mask of the roles of its properties
    int64_t count;  // at most PLY_COUNT_LIMIT unless kind is PLY_OTHER
    size_t first_property, property_count;
} PlyElement;

typedef struct {
    ARRAY(PlyElement) elements; // all but PLY_OTHER have the properties that a mesh needs
    ARRAY(PlyProperty) properties;
    int64_t vertex_count;
    bool has_normals, has_colors;
} PlyHeader;

// The properties of one element, in the file's order; borrowed from the header.
typedef struct {
    const PlyProperty *data;
    size_t count;
} PlyProperties;

// Parses the header. On success, the reader points at the body and has the body's format. The
// caller frees the header, even after a failure.
bool ply_header_parse(PlyHeader *header, PlyReader *reader);
void ply_header_free(PlyHeader *header);

PlyProperties ply_header_properties(const PlyHeader *header, const PlyElement *element);

// The fast path for binary PLY files with the usual layout. It stops before the first unusual or
// invalid element. The general reader continues at this element and reports faults.

// Reads the vertices from reader->index to count - 1. Reads none if a property is a list or a used
// property is an integer. Advances reader->index and reader->next past the vertices read.
void ply_bulk_vertices(PlyReader *reader, PlyProperties properties, int64_t count, Mesh *mesh);

// Returns the size of a triangle in the file in bytes, or 0 for unusual layouts. In the usual
// layout, a face has one list: its corners, with a 1-byte length and 4-byte indices.
size_t ply_bulk_triangle_size(const PlyReader *reader, PlyProperties properties);

// Reads at most `room` triangles from reader->index on. Stops at a face that does not have three
// corners in [0, vertex_count). Advances the reader and returns the number of triangles read.
size_t ply_bulk_triangles(PlyReader *reader, PlyProperties properties, int64_t vertex_count,
                          size_t room, uint32_t (*triangles)[3]);
