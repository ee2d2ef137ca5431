// SPDX-License-Identifier: MIT
// A file of checksummed records, to which a long job appends its results. A later run resumes from
// them. Reading stops at the first damaged record, and journal_cut removes the rest.
#pragma once

#include "base/error.h"

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

typedef struct {
    FILE *stream;     // NULL if closed
    const char *path; // borrowed
    uint64_t records; // records read and written
} Journal;

// Returns whether path is a file at least as long as a journal's head.
bool journal_exists(const char *path);

// Opens the journal at path, or creates one with this key. Fails if the journal has another key or
// another process has it open.
bool journal_open(Journal *journal, const char *path, const uint64_t key[2], Error *error);

// Reads the next record, which must have size bytes. Returns false at the end or at a damaged
// record. All records must be read before one is added.
bool journal_read(Journal *journal, void *bytes, size_t size);

// Removes everything after the last record read.
bool journal_cut(Journal *journal, Error *error);

bool journal_add(Journal *journal, const void *bytes, size_t size, Error *error);

// Closes the journal, and deletes its file if is_done.
void journal_close(Journal *journal, bool is_done);
