// SPDX-License-Identifier: MIT
// The header of a PLY file: which elements follow, how many, and what a value means to a Mesh.
#pragma once

#include "base/array.h"
#include "base/limits.h"
#include "mesh/ply_reader.h"

#define PLY_COUNT_LIMIT      MESH_COUNT_MOST
#define PLY_COORDINATE_BOUND COORDINATE_MOST

// What a property is to the mesh: the component of that number, the corners of a face, or nothing.
typedef enum {
    PLY_X,
    PLY_Y,
    PLY_Z,
    PLY_NORMAL_X,
    PLY_NORMAL_Y,
    PLY_NORMAL_Z,
    PLY_CORNERS,
    PLY_UNUSED,
} PlyRole;

typedef struct {
    PlyRole role;
    PlyType type; // of the value, or of a list's items
    bool is_list;
    PlyType length_type; // of lists only; an integer type
} PlyProperty;

typedef enum { PLY_VERTEX, PLY_FACE, PLY_OTHER } PlyKind;

typedef struct {
    PlyWord name;
    PlyKind kind;
    unsigned roles; // a bit for each role that its properties have
    int64_t count;  // at most PLY_COUNT_LIMIT for vertices and faces
    size_t first_property, property_count;
} PlyElement;

typedef struct {
    ARRAY(PlyElement) elements; // with all that a mesh needs of vertices and faces
    ARRAY(PlyProperty) properties;
    int64_t vertex_count;
    bool has_normals;
} PlyHeader;

// Those of one element, in the file's order; borrowed from the header.
typedef struct {
    const PlyProperty *data;
    size_t count;
} PlyProperties;

// Parses the header at the reader's start; then the reader stands before the body and knows its
// format.  The header is to be freed in either case.
bool ply_header_parse(PlyHeader *header, PlyReader *reader);
void ply_header_free(PlyHeader *header);

PlyProperties ply_header_properties(const PlyHeader *header, const PlyElement *element);
