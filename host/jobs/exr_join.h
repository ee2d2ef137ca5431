// SPDX-License-Identifier: MIT
// The EXR files of parts -> the EXR file of the whole picture. Two passes over the parts copy the
// tiles without decoding them: the first records the tiles' sizes, and the second copies. The
// memory needed is one tile, and eight bytes for each tile of the picture.
#pragma once

#include "image/exr_file.h"
#include "render/renderer.h"

typedef struct {
    RenderSettings whole; // the settings of the whole picture
    uint64_t count;       // tiles of the whole picture
    uint64_t *starts;     // the tiles' sizes during the first pass, then their positions; owned
    unsigned char *tile;  // room for a tile and its head; owned
} ExrJoin;

// Allocates the memory for the whole picture. `file` is one of its parts, and `settings` are that
// part's settings.
bool exr_join_begin(ExrJoin *join, const ExrFile *file, const RenderSettings *settings,
                    Error *error);
void exr_join_free(ExrJoin *join);

// First pass: records the sizes of the part's tiles. Fails if a tile is missing.
bool exr_join_measure(ExrJoin *join, const ExrFile *file, const RenderSettings *settings,
                      Error *error);

// Writes the header and the table of tiles. Call it after the first pass. On failure, errno has the
// reason.
bool exr_join_write_head(ExrJoin *join, const ExrFile *file, const Provenance *provenance,
                         FILE *stream);

// Second pass: copies the part's tiles. On failure, errno has the reason. It is 0 if the part has
// changed since the first pass.
bool exr_join_copy(const ExrJoin *join, const ExrFile *file, const RenderSettings *settings,
                   FILE *stream);
