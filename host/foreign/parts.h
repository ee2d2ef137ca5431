// SPDX-License-Identifier: MIT
// Sends a model's parts. A part is a run of triangles with one material, in the coordinates of the
// whole file.
#pragma once

#include "foreign/send.h"

#include <assimp/scene.h>

typedef struct {
    size_t triangles;
    size_t others;    // faces that are points or lines
    bool is_textured; // the color of a part has a texture, which clrt does not render
    bool is_colored;  // a part's vertices have colors
} PartCounts;

// Sends every part after its material. keeps_normals is false for formats with facet normals, which
// the corners already determine.
bool parts_send(FILE *stream, const struct aiScene *scene, bool keeps_normals, PartCounts *counts,
                Error *error);
