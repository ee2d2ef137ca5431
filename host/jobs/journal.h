// SPDX-License-Identifier: MIT
// A journal is a file of checksummed records. A long job appends its results, and a later run
// resumes from them, as a database recovers from its log (Gray and Reuter, "Transaction
// processing", 1993). The file's head contains a key. A run with other settings has another key,
// and cannot resume.
//
// Each record has its number, its size and a checksum. A killed process may leave an incomplete
// record. Reading therefore stops at the first record that is incomplete or damaged, and
// journal_claim drops the rest.
//
// Two processes must not append to one journal. A lock prevents this on one machine, but not on
// every network file system. journal_claim therefore copies the records into a new file under the
// same name. A process that still has the old file open can only append to the old file.
//
// Invariant: all records before the first damaged one are complete and in their original order.
#pragma once

#include "base/error.h"

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

typedef struct {
    FILE *stream;     // NULL if closed
    const char *path; // borrowed
    uint64_t records; // number of records read and written
    bool is_busy;     // journal_open or journal_claim failed because of another process
    bool is_broken;   // the file cannot be opened or written
} Journal;

// Opens the journal at `path` for reading, or creates one with `key`. Fails if the journal has
// another key, or if another process has locked the journal.
bool journal_open(Journal *journal, const char *path, const uint64_t key[2], Error *error);

// Reads the next record, which must have `size` bytes. Returns false at the end or at a damaged
// record. All records must be read before journal_claim.
bool journal_read(Journal *journal, void *bytes, size_t size);

// Replaces the journal by a new file with the records that were read. journal_add requires this
// call. A process on another machine may still write to the old file, but not to the new one.
bool journal_claim(Journal *journal, Error *error);

bool journal_add(Journal *journal, const void *bytes, size_t size, Error *error);

// Closes the journal. Deletes its file if `is_done`, unless another process has claimed the
// journal.
void journal_close(Journal *journal, bool is_done);
