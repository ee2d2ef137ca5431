// SPDX-License-Identifier: MIT
// The header of a PLY file: its elements, their counts, and each property's role in a Mesh.
#pragma once

#include "base/array.h"
#include "base/limits.h"
#include "mesh/ply_reader.h"

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
    int64_t count;  // at most PLY_COUNT_LIMIT unless `kind` is PLY_OTHER
    size_t first_property, property_count;
} PlyElement;

typedef struct {
    ARRAY(PlyElement) elements; // only empty ones and PLY_OTHER may lack needed properties
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
