// SPDX-License-Identifier: MIT
// Splits Assimp's scene into parts, each a run of triangles of one material, in the coordinates of
// the whole file.
#pragma once

#include "mesh/foreign_stream.h"

#include <assimp/scene.h>
#include <stdio.h>

typedef struct {
    size_t triangles;
    size_t others;    // faces that are points or lines
    bool is_textured; // the color of a part has a texture
} PartCounts;

// Sends every part after its material. Facet normals are omitted, because the corners already
// determine them.
bool parts_send(FILE *stream, const struct aiScene *scene, bool keeps_normals, PartCounts *counts,
                Error *error);
