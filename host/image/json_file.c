// SPDX-License-Identifier: MIT
// Jansson formats the text. Every write is checked.
#include "image/json_file.h"

#include "base/output_file.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

json_t *json_file_path(const char *path)
{
    char shown[4096];
    json_t *valid = json_string(path);
    if (valid != NULL)
        return valid;
    snprintf(shown, sizeof shown, "%s", path);
    for (char *c = shown; *c != '\0'; c++)
        if ((unsigned char)*c >= 0x80)
            *c = '?';
    return json_string(shown);
}

json_t *json_count(uint64_t count)
{
    return json_integer((json_int_t)count);
}

json_t *json_finite(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

static bool write_text(void *text, FILE *stream, Error *cause)
{
    (void)cause;
    return fprintf(stream, "%s\n", (const char *)text) > 0 && fflush(stream) == 0;
}

bool json_file_write(json_t *root, const char *path, Error *error)
{
    char *text = root == NULL ? NULL : json_dumps(root, JSON_INDENT(2) | JSON_SORT_KEYS);
    json_decref(root);
    if (text == NULL)
        return error_set(error, "%s: it cannot be written as JSON", path);
    const bool ok =
        strcmp(path, "-") != 0
            ? output_file_write(path, write_text, text, error)
            : write_text(text, stdout, error) ||
                  error_set(error, "standard output: cannot be written: %s", strerror(errno));
    free(text);
    return ok;
}
