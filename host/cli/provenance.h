// SPDX-License-Identifier: MIT
// A report -> the texts that a picture's file carries: where it comes from, in strings alone, since
// PNG keeps no other type.
#pragma once

#include "cli/report.h"

#define PROVENANCE_TEXTS (STORED_TEXTS + 2)

typedef struct {
    char texts[STORED_TEXTS][STORED_TEXT_SIZE];
    char software[64], date[24];
    ImageText list[PROVENANCE_TEXTS]; // of the above, so that it stays where it was made
    size_t count;
} Provenance;

// Whether SOURCE_DATE_EPOCH, where the environment has it, is a number of seconds.
bool provenance_check_date(Error *error);

// Fills the texts, whose names are told in tools/manual/clrt.1.in.
void provenance_fill(Provenance *provenance, const Report *report);

// Writes settings on one line, as short as it goes.
void provenance_write_settings(char text[STORED_TEXT_SIZE], const json_t *settings);

// Lists the texts for a file.  A date is among them where SOURCE_DATE_EPOCH gives one: two
// identical runs write identical files.
void provenance_list(Provenance *provenance);

// Prints the hash of a picture's pixels where the options ask for it; false where it is not the one
// they expect.
bool provenance_tell_hash(const Options *options, const char *hash, Error *error);
