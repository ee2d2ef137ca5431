// SPDX-License-Identifier: MIT
// The records that clrt-foreign sends for a model -> ForeignModel. The parser validates everything,
// because a hostile file may control clrt-foreign.
#pragma once

#include "base/array.h"
#include "base/foreign.h"
#include "mesh/mesh.h"
#include "mesh/ply.h"

#define FOREIGN_NO_MATERIAL UINT32_MAX // ForeignHead::number of a part without a material

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
    char *note;                       // a message about omitted data, or NULL; owned
} ForeignModel;

// Returns whether clrt-foreign reads models with the path's extension. The case of letters does not
// matter. Only the extension counts, because most of Assimp's formats have no magic bytes.
bool foreign_format_is(const char *path);

// Fills `model` from a stream. `name` is the model file's name for messages, and `is_tolerant` is
// PlySource::is_tolerant. Returns false if the stream is damaged or reports a failure, or if memory
// runs out.
bool foreign_stream_parse(ForeignModel *model, const File *stream, const char *name,
                          bool is_tolerant, Error *error);
void foreign_model_free(ForeignModel *model);
