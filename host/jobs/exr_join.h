// SPDX-License-Identifier: MIT
// The EXR files of parts -> the EXR file of the whole picture. Two passes over the parts copy the
// compressed tiles: the first records the tiles' sizes, and the second checks and copies. The
// memory needed is a few tiles, and eight bytes for each tile of the picture.
#pragma once

#include "image/exr_file.h"
#include "render/renderer.h"

#include <stdio.h>

typedef struct {
    uint64_t count;   // tiles of the whole picture
    uint64_t *starts; // the tiles' sizes during the first pass, then their positions; owned
} ExrJoin;

// Allocates the memory for the whole picture. `settings` are those of one of its parts.
bool exr_join_begin(ExrJoin *join, const RenderSettings *settings, Error *error);
void exr_join_free(ExrJoin *join);

// First pass: records the sizes of the part's tiles. Fails if a tile is missing.
bool exr_join_measure(ExrJoin *join, const ExrFile *file, const RenderSettings *settings,
                      Error *error);

// Fills the table of tiles of an EXR file without tiles. Call it after the first pass. On failure,
// errno has the reason.
bool exr_join_write_table(ExrJoin *join, FILE *stream);

// Second pass: copies the part's tiles. If writing fails, errno has the reason. It is 0 if the part
// is damaged, or has changed since the first pass.
bool exr_join_copy(const ExrJoin *join, const ExrFile *file, const RenderSettings *settings,
                   FILE *stream, Error *error);
