// SPDX-License-Identifier: MIT
// Joins the EXR files of parts into the EXR file of the whole picture. The first pass over the
// parts records the sizes of the compressed tiles. The second pass checks and copies the tiles.
// Joining takes memory for one tile per processor, and eight bytes for each tile of the picture.
#pragma once

#include "image/exr_file.h"
#include "image/image_settings.h"
#include "session/picture.h"

#include <stdatomic.h>

typedef struct {
    uint64_t count;   // tiles of the whole picture
    uint64_t *starts; // the tiles' sizes during the first pass, then the tiles' positions; owned
    atomic_int write_error; // the errno of a failed write; 0 if no write has failed
} ExrJoin;

// Allocates join->starts for the whole picture. The caller frees join->starts. `file` may be any of
// the parts.
bool exr_join_begin(ExrJoin *join, const ExrFile *file, Error *error);

// First pass: records the sizes of the part's tiles. Fails if a tile is missing.
bool exr_join_measure(ExrJoin *join, const ExrFile *file, const RenderSettings *settings,
                      Error *error);

// Writes the header of the picture and the table of tiles. The first pass must be complete. `place`
// contains the picture's size. On failure, errno has the reason.
bool exr_join_write_head(ExrJoin *join, const ImageSettings *settings, const RenderSettings *place,
                         FILE *stream);

// Second pass: copies the part's tiles. Fails if writing fails, if a tile is damaged, or if its
// size has changed since the first pass.
bool exr_join_copy(ExrJoin *join, const ExrFile *file, const RenderSettings *settings, FILE *stream,
                   Error *error);
