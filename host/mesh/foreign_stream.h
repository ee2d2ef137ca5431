// SPDX-License-Identifier: MIT
// The output of clrt-foreign, which runs Assimp (host/foreign): records, each a head and data.
// The reader validates everything, because a hostile file may have taken over Assimp.
#pragma once

#include "base/array.h"
#include "mesh/mesh.h"
#include "mesh/ply.h"

typedef enum {
    FOREIGN_FILE = 1, // a ForeignHash and the path of an input file; the model file comes first
    FOREIGN_MATERIAL, // a ForeignMaterial
    FOREIGN_PART,     // a binary PLY file; number is the index of its material
    FOREIGN_NOTE,     // a message about omitted parts
    FOREIGN_FAILURE,  // the reason why there is no model; the last record
    FOREIGN_END       // no bytes; the last record of a complete stream
} ForeignKind;

#define FOREIGN_NO_MATERIAL UINT32_MAX // ForeignHead::number of a part without a material

typedef struct {
    uint32_t kind, number;
    uint64_t size; // number of bytes that follow
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
    uint32_t material; // index in ForeignModel::materials, or FOREIGN_NO_MATERIAL
} ForeignPart;

typedef struct {
    ARRAY(ForeignPart) parts;
    ARRAY(ForeignMaterial) materials; // names are printable ASCII; colors are from 0 to 1
    ARRAY(char *) files;              // paths; owned
    ARRAY(ForeignHash) hashes;        // hashes[i] belongs to files[i]
    char *note;                       // a message about omitted parts, or NULL; owned
} ForeignModel;

typedef struct {
    const char *bytes;
    size_t size;
} ForeignStream;

// Fills model from a stream. name is the model file's name for messages, and parse reads the parts.
// Returns false if the stream is damaged or reports a failure.
bool foreign_stream_parse(ForeignModel *model, ForeignStream stream, const char *name,
                          PlyParse *parse, Error *error);
void foreign_model_free(ForeignModel *model);
