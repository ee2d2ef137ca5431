// SPDX-License-Identifier: MIT
// --resume: the journal FILE.part, or an incomplete EXR file -> the tiles that an earlier run has
// finished, and the journal of this run.
#pragma once

#include "cli/options/options.h"
#include "image/provenance.h"
#include "jobs/journal.h"

typedef struct {
    char *path;         // of the journal; NULL without --resume; owned
    StoredImage stored; // the earlier picture; empty if missing or if a journal replaces it
    const char *stored_path;
    Journal journal;
    bool is_broken; // the journal cannot be written
    float *tile;    // a tile's colors, row by row; owned
} Resume;

// Returns the name of the journal beside a picture, which the caller frees; NULL without memory.
char *resume_journal_name(const char *output_path, Error *error);

// Looks for the files of an earlier run.  Only main may call it, before other threads start,
// because a child process reads pictures.
bool resume_look(Resume *resume, const Options *options, Error *error);

// Copies the finished tiles into framebuffer, stores their number in settings->ready_tiles and
// opens the journal.  Scene and settings in own must match the earlier run's.
bool resume_open(Resume *resume, const Provenance *own, RenderSettings *settings,
                 Framebuffer *framebuffer, Error *error);

// Adds a tile of the framebuffer to the journal.  Tiles must come in the order of their numbers.
bool resume_keep(Resume *resume, const RenderSettings *settings, const Framebuffer *framebuffer,
                 uint64_t number, Error *error);

// Closes the journal, and removes it if the picture is complete.
void resume_close(Resume *resume, bool is_done);
