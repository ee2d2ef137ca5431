// SPDX-License-Identifier: MIT
// The texts stored in a picture's file, which record its origin. All are strings, because PNG
// stores no other type.
#pragma once

#include "image/image_file.h"
#include "image/stored_image.h"

#include <jansson.h>

#define PROVENANCE_TEXTS (STORED_TEXTS + 2)

typedef struct {
    char texts[STORED_TEXTS][STORED_TEXT_SIZE]; // tools/manual/clrt.1.in describes them
    char software[64], date[24];
    ImageText list[PROVENANCE_TEXTS]; // points into the arrays above
    size_t count;
} Provenance;

// Rejects a SOURCE_DATE_EPOCH in the environment that is not a number of seconds.
bool provenance_check_date(Error *error);

// Writes settings as compact JSON on one line.
void provenance_write_settings(char text[STORED_TEXT_SIZE], const json_t *settings);

// Lists the texts for a file. SOURCE_DATE_EPOCH adds a date; identical runs write identical files.
void provenance_list(Provenance *provenance);
