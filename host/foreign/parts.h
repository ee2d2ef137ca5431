// SPDX-License-Identifier: MIT
// Assimp's scene -> parts, each the triangles of one material that follow each other, in the
// coordinates of the whole file.
#pragma once

#include "mesh/foreign_stream.h"

#include <assimp/scene.h>
#include <stdio.h>

typedef struct {
    size_t triangles;
    size_t others;    // faces that are points or lines
    bool is_textured; // the color of a part has a texture
} PartCounts;

// Sends every part behind its material.  Normals are kept unless they are those of facets, which
// say nothing that corners do not.
bool parts_send(FILE *stream, const struct aiScene *scene, bool keeps_normals, PartCounts *counts,
                Error *error);
