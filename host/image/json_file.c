// SPDX-License-Identifier: MIT
// Jansson formats the text. Every write is checked.
#include "image/json_file.h"

#include "base/output_file.h"

#include <errno.h>
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

static bool write_text(const char *text, const char *path)
{
    FILE *stream = strcmp(path, "-") == 0 ? stdout : fopen(path, "w");
    bool ok = stream != NULL && fprintf(stream, "%s\n", text) > 0 && fflush(stream) == 0;
    if (stream != NULL && stream != stdout)
        ok = fclose(stream) == 0 && ok;
    return ok;
}

static bool write_file(const char *text, const char *path, Error *error)
{
    OutputFile file;
    Error cause = {0};
    if (!output_file_begin(&file, path, error))
        return false;
    const bool ok = write_text(text, file.temporary) || error_set(&cause, "%s", strerror(errno));
    return output_file_end(&file, ok, &cause) ||
           error_set(error, "%s: cannot be written: %s", path, cause.text);
}

bool json_file_write(json_t *root, const char *path, Error *error)
{
    char *text = root == NULL ? NULL : json_dumps(root, JSON_INDENT(2) | JSON_SORT_KEYS);
    json_decref(root);
    if (text == NULL)
        return error_set(error, "%s: it cannot be written as JSON", path);
    bool ok;
    if (strcmp(path, "-") == 0)
        ok = write_text(text, path) ||
             error_set(error, "standard output: cannot be written: %s", strerror(errno));
    else
        ok = write_file(text, path, error);
    free(text);
    return ok;
}
