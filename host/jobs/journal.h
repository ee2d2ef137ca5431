// SPDX-License-Identifier: MIT
// A file that records are added to while a long job runs, so that it can go on after whatever ended
// it.  Records are told whole from torn by a checksum: a torn one ends the file, and is cut off.
#pragma once

#include "base/error.h"

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

typedef struct {
    FILE *stream;     // NULL where none is open
    const char *path; // borrowed
    uint64_t records; // read and added
} Journal;

// Whether path holds the beginning of a journal.
bool journal_exists(const char *path);

// Opens the journal at path, which must be of the same key, or begins one.  No two processes have
// it open at once.
bool journal_open(Journal *journal, const char *path, const uint64_t key[2], Error *error);

// Reads the next record, which is of that size; false where none follows.  To be called until then,
// before any is added.
bool journal_read(Journal *journal, void *bytes, size_t size);

// Cuts off what follows the last record that was read.
bool journal_cut(Journal *journal, Error *error);

bool journal_add(Journal *journal, const void *bytes, size_t size, Error *error);

// Closes the journal, and removes it where the job is done.
void journal_close(Journal *journal, bool is_done);
