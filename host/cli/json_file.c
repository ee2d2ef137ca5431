// SPDX-License-Identifier: MIT
// Jansson makes the text; writing it is checked to the end.
#include "cli/json_file.h"

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

bool json_file_write(json_t *root, const char *path, Error *error)
{
    char *text = root == NULL ? NULL : json_dumps(root, JSON_INDENT(2) | JSON_SORT_KEYS);
    json_decref(root);
    if (text == NULL)
        return error_set(error, "%s: it cannot be written as JSON", path);
    FILE *stream = strcmp(path, "-") == 0 ? stdout : fopen(path, "w");
    bool ok = stream != NULL && fprintf(stream, "%s\n", text) > 0 && fflush(stream) == 0;
    if (stream != NULL && stream != stdout)
        ok = fclose(stream) == 0 && ok;
    free(text);
    return ok || error_set(error, "%s: cannot be written: %s", path, strerror(errno));
}
