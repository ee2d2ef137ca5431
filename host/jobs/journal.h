// SPDX-License-Identifier: MIT
// A file of checksummed records that a long job appends to, so that a later run can resume it.  A
// torn record ends the file and is cut off.
#pragma once

#include "base/error.h"

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

typedef struct {
    FILE *stream;     // NULL if closed
    const char *path; // borrowed
    uint64_t records; // read and written
} Journal;

// Returns whether path holds at least a journal's head.
bool journal_exists(const char *path);

// Opens the journal at path, or creates one.  Fails if its key differs or another process holds it.
bool journal_open(Journal *journal, const char *path, const uint64_t key[2], Error *error);

// Reads the next record, of exactly size bytes; returns false at the end.  All records must be read
// before one is added.
bool journal_read(Journal *journal, void *bytes, size_t size);

// Cuts off everything after the last record read.
bool journal_cut(Journal *journal, Error *error);

bool journal_add(Journal *journal, const void *bytes, size_t size, Error *error);

// Closes the journal, and removes it if the job is done.
void journal_close(Journal *journal, bool is_done);
