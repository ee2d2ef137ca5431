// SPDX-License-Identifier: MIT
// What the program that holds Assimp (host/foreign) writes about a file: records, each a head and
// its bytes.  The reader believes none of it: Assimp may have been taken over by what it read.
#pragma once

#include "base/array.h"
#include "mesh/mesh.h"
#include "mesh/ply.h"

typedef enum {
    FOREIGN_FILE = 1, // a ForeignHash and the path of a file that was read, the model's first
    FOREIGN_MATERIAL, // a ForeignMaterial
    FOREIGN_PART,     // a binary PLY file; number is its material's, counted from 0
    FOREIGN_NOTE,     // a sentence on what was left out
    FOREIGN_FAILURE,  // why there is no model; the last record
    FOREIGN_END       // nothing; the last record
} ForeignKind;

#define FOREIGN_NO_MATERIAL UINT32_MAX // the number of a part that has none

typedef struct {
    uint32_t kind, number;
    uint64_t size; // of what follows
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
    uint32_t material; // of the model's, or FOREIGN_NO_MATERIAL
} ForeignPart;

typedef struct {
    ARRAY(ForeignPart) parts;
    ARRAY(ForeignMaterial) materials; // named in printable ASCII; colors from 0 to 1
    ARRAY(char *) files;              // owned
    ARRAY(ForeignHash) hashes;        // of those files
    char *note;                       // NULL where nothing is to be told; owned
} ForeignModel;

typedef struct {
    const char *bytes;
    size_t size;
} ForeignStream;

// Fills model from a stream about the file called name, whose parts are read by parse.  False with
// a sentence where the stream is damaged or tells of a failure.
bool foreign_stream_parse(ForeignModel *model, ForeignStream stream, const char *name,
                          PlyParse *parse, Error *error);
void foreign_model_free(ForeignModel *model);
