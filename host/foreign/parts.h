// SPDX-License-Identifier: MIT
// Sends Assimp's scene as records of parts. A part is a run of triangles with one material, in the
// coordinates of the whole file.
#pragma once

#include "foreign/send.h"

#include <assimp/scene.h>

typedef struct {
    size_t triangles;
    size_t others;    // faces that are points or lines
    bool is_textured; // the color of a part has a texture, which clrt does not render
} PartCounts;

// Sends each part after its material. `keeps_normals` is false for file formats with one normal per
// triangle, because the triangle's corners determine this normal.
bool parts_send(FILE *stream, const struct aiScene *scene, bool keeps_normals, PartCounts *counts,
                Error *error);
