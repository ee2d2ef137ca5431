// SPDX-License-Identifier: MIT
// Lists the texts that describe a picture's origin. A file's date comes only from
// SOURCE_DATE_EPOCH, so that equal runs write equal files.
#include "image/provenance.h"

#include "base/number.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

// The last second of the year 9999.
#define DATE_LAST 253402300799

static bool read_date(const char *text, int64_t *seconds)
{
    const char *end = text + strlen(text);
    return integer_parse(text, end, seconds) == end && *seconds >= 0 && *seconds <= DATE_LAST;
}

bool provenance_check_date(Error *error)
{
    int64_t seconds;
    const char *text = getenv("SOURCE_DATE_EPOCH");
    return text == NULL || read_date(text, &seconds) ||
           error_set(error, "SOURCE_DATE_EPOCH must be seconds since 1970, not '%s'", text);
}

// Writes the UTC date in the format of EXIF, TIFF and EXR. Returns false if SOURCE_DATE_EPOCH is
// unset or invalid.
static bool write_date(char *date, size_t size)
{
    struct tm parts;
    int64_t seconds;
    const char *text = getenv("SOURCE_DATE_EPOCH");
    if (text == NULL || !read_date(text, &seconds))
        return false;
    const time_t moment = (time_t)seconds;
    return gmtime_r(&moment, &parts) != NULL &&
           strftime(date, size, "%Y:%m:%d %H:%M:%S", &parts) > 0;
}

void provenance_write_settings(char text[STORED_TEXT_SIZE], const json_t *settings)
{
    const size_t length = json_dumpb(settings, text, STORED_TEXT_SIZE - 1,
                                     JSON_SORT_KEYS | JSON_COMPACT | JSON_REAL_PRECISION(6));
    text[length < STORED_TEXT_SIZE ? length : 0] = '\0';
}

static void add(Provenance *provenance, const char *name, const char *value)
{
    provenance->list[provenance->count++] = (ImageText){name, value};
}

void provenance_list(Provenance *provenance)
{
    provenance->count = 0;
    snprintf(provenance->software, sizeof provenance->software, "clrt %.40s",
             provenance->texts[STORED_VERSION]);
    add(provenance, "Software", provenance->software);
    if (write_date(provenance->date, sizeof provenance->date))
        add(provenance, "DateTime", provenance->date);
    for (int kind = 0; kind < STORED_TEXTS; kind++)
        add(provenance, stored_text_names[kind], provenance->texts[kind]);
}
