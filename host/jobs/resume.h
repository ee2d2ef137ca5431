// SPDX-License-Identifier: MIT
// Restores the tiles that an earlier run stored in the journal FILE.part (--resume). The present
// run appends its own tiles to the journal. If the journal has no tiles, and FILE is a complete EXR
// file, all tiles are finished.
#pragma once

#include "image/exr_file.h"
#include "image/provenance.h"
#include "jobs/journal.h"
#include "session/picture.h"

typedef struct {
    char *path;              // the journal's path; NULL without --resume; owned
    const char *stored_path; // of the earlier run's EXR file; NULL for other formats
    ExrFile stored;          // the earlier run's EXR file, while its tiles are copied
    Journal journal;
    float *tile; // the colors of one tile, row by row; owned
} Resume;

// Returns the journal's path for a picture's path, or NULL if memory runs out. The caller frees the
// result.
char *resume_journal_name(const char *output_path, Error *error);

// Prepares to resume the picture at `path`. If `is_exr`, the picture's file can also contain
// finished tiles. Fails if `path` exists and is not a regular file.
bool resume_prepare(Resume *resume, const char *path, bool is_exr, Error *error);

// Opens the journal and copies its tiles into `framebuffer`. If the journal has no tiles, a
// complete EXR file provides them. Stores the number of finished tiles in settings->ready_tiles.
// `own` is the metadata of the finished picture. Fails if the earlier run had another scene, other
// settings or another version of clrt.
bool resume_open(Resume *resume, const Provenance *own, RenderSettings *settings,
                 Framebuffer *framebuffer, Error *error);

// Appends the tile `number` to the journal. Callers append tiles in ascending order.
bool resume_keep(Resume *resume, const RenderSettings *settings, const Framebuffer *framebuffer,
                 uint64_t number, Error *error);

// Closes the journal, and deletes its file if `is_done`.
void resume_close(Resume *resume, bool is_done);
