// SPDX-License-Identifier: MIT
// A report -> the texts that a picture's file carries: where it comes from, in strings alone, since
// PNG keeps no other type.
#pragma once

#include "cli/report.h"

#define PROVENANCE_TEXTS    12
#define PROVENANCE_SETTINGS 512

// Strings of the texts that the report does not hold live here, so it stays where it was made.
typedef struct {
    ImageText texts[PROVENANCE_TEXTS];
    size_t count;
    char scene_hash[SCENE_HASH_SIZE], mesh_hash[SCENE_HASH_SIZE];
    char settings[PROVENANCE_SETTINGS]; // JSON on one line
    char date[24];
} Provenance;

// Whether SOURCE_DATE_EPOCH, where the environment has it, is a number of seconds.
bool provenance_check_date(Error *error);

// The names are told in tools/manual/clrt.1.in.  A date is among them where SOURCE_DATE_EPOCH gives
// one: two identical runs write identical files.
void provenance_make(Provenance *provenance, const Report *report);
