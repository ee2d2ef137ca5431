// SPDX-License-Identifier: MIT
// The texts in a picture's file that record how clrt made the picture. All values are strings,
// because PNG stores no other type.
#pragma once

#include "image/image_file.h"
#include "image/stored_image.h"

#include <jansson.h>

#define PROVENANCE_TEXTS (STORED_TEXTS + 2)

typedef struct {
    char texts[STORED_TEXTS][STORED_TEXT_SIZE]; // described in tools/manual/clrt.1.in
    char software[64], date[24];
    ImageText list[PROVENANCE_TEXTS]; // its values point into the arrays above
    size_t count;
} Provenance;

// Returns whether SOURCE_DATE_EPOCH is unset or a valid number of seconds since 1970.
bool provenance_check_date(Error *error);

// Writes `settings` as one line of compact JSON. The text is empty if the JSON does not fit.
void provenance_write_settings(char text[STORED_TEXT_SIZE], const json_t *settings);

// Fills `software`, `date` and `list`. The caller must have filled `texts`. The list has a date
// only if SOURCE_DATE_EPOCH is set and valid.
void provenance_list(Provenance *provenance);
