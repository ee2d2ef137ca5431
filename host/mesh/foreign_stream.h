// SPDX-License-Identifier: MIT
// The output of the program that holds Assimp (host/foreign): records, each a head and its bytes.
// The reader trusts none of it, because a hostile file may have taken over Assimp.
#pragma once

#include "base/array.h"
#include "mesh/mesh.h"
#include "mesh/ply.h"

typedef enum {
    FOREIGN_FILE = 1, // a ForeignHash and the path of an input file, the model's first
    FOREIGN_MATERIAL, // a ForeignMaterial
    FOREIGN_PART,     // a binary PLY file; number is its material's, counted from 0
    FOREIGN_NOTE,     // a message about omitted parts
    FOREIGN_FAILURE,  // the reason why there is no model; the last record
    FOREIGN_END       // empty; the last record
} ForeignKind;

#define FOREIGN_NO_MATERIAL UINT32_MAX // the number of a part without a material

typedef struct {
    uint32_t kind, number;
    uint64_t size; // of the following bytes
} ForeignHead;

typedef struct {
    uint64_t words[2]; // XXH3 of a file's bytes
} ForeignHash;

typedef struct {
    char name[32];
    float diffuse[3], specular[3];
    float shininess; // 0 without highlights
} ForeignMaterial;

typedef struct {
    Mesh mesh;
    uint32_t material; // index in the model, or FOREIGN_NO_MATERIAL
} ForeignPart;

typedef struct {
    ARRAY(ForeignPart) parts;
    ARRAY(ForeignMaterial) materials; // with names in printable ASCII and colors from 0 to 1
    ARRAY(char *) files;              // owned
    ARRAY(ForeignHash) hashes;        // of those files
    char *note;                       // about omitted parts, NULL without any; owned
} ForeignModel;

typedef struct {
    const char *bytes;
    size_t size;
} ForeignStream;

// Fills model from a stream about the file called name. parse reads the parts. Returns false with
// a message if the stream is damaged or reports a failure.
bool foreign_stream_parse(ForeignModel *model, ForeignStream stream, const char *name,
                          PlyParse *parse, Error *error);
void foreign_model_free(ForeignModel *model);
