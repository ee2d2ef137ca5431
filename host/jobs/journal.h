// SPDX-License-Identifier: MIT
// A journal is a file of checksummed records. A long job appends its results, and a later run
// resumes the job from them. Reading stops at the first damaged record; journal_cut removes it and
// everything after it.
#pragma once

#include "base/error.h"

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

typedef struct {
    FILE *stream;     // NULL if closed
    const char *path; // borrowed
    uint64_t records; // number of records read and written
} Journal;

// Returns whether path is a regular file at least as long as a journal's head.
bool journal_exists(const char *path);

// Opens the journal at path, or creates one with this key. Fails if the journal has another key or
// another process has it open.
bool journal_open(Journal *journal, const char *path, const uint64_t key[2], Error *error);

// Reads the next record, which must have size bytes. Returns false at the end or at a damaged
// record. Callers must read all records before they add one.
bool journal_read(Journal *journal, void *bytes, size_t size);

// Removes everything after the last record read.
bool journal_cut(Journal *journal, Error *error);

bool journal_add(Journal *journal, const void *bytes, size_t size, Error *error);

// Closes the journal. Deletes its file if is_done.
void journal_close(Journal *journal, bool is_done);
