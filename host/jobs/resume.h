// SPDX-License-Identifier: MIT
// --resume: the tiles that an earlier run has left, in the journal FILE.part or in an EXR file that
// was stopped -> the tiles that need not be drawn again; and the journal of this one.
#pragma once

#include "cli/options/options.h"
#include "image/provenance.h"
#include "jobs/journal.h"

typedef struct {
    char *path;         // of the journal; NULL without --resume; owned
    StoredImage stored; // the earlier picture, empty where there is none or a journal is better
    const char *stored_path;
    Journal journal;
    bool is_broken; // the journal cannot be written
    float *tile;    // a tile's colors, row by row; owned
} Resume;

// Returns the name of the journal that --resume keeps beside a picture.  The caller frees it; NULL
// when memory ran out.
char *resume_journal_name(const char *output_path, Error *error);

// Looks for what is left of an earlier run.  For main alone, while no other thread runs, as
// pictures are read by a process of their own.
bool resume_look(Resume *resume, const Options *options, Error *error);

// Fills framebuffer with the tiles that are there, whose number is left in settings->ready_tiles,
// and opens the journal.  The scene and the settings among own's texts must be those of the earlier
// run.
bool resume_open(Resume *resume, const Provenance *own, RenderSettings *settings,
                 Framebuffer *framebuffer, Error *error);

// Keeps a tile of the framebuffer in the journal, in the order of their numbers.
bool resume_keep(Resume *resume, const RenderSettings *settings, const Framebuffer *framebuffer,
                 uint64_t number, Error *error);

// Ends with the journal, which is removed where the picture is written whole.
void resume_close(Resume *resume, bool is_done);
