// SPDX-License-Identifier: MIT
// Makes JSON objects with Jansson, writes them, and prints their values by templates.
#include "image/json_file.h"

#include "base/output_file.h"
#include "base/print.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define NAME_SIZE 64

json_t *json_file_path(const char *path)
{
    char shown[4096];
    json_t *valid = path == NULL ? json_null() : json_string(path);
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

json_t *json_two(uint32_t one, uint32_t other)
{
    return json_pack("[oo]", json_count(one), json_count(other));
}

json_t *json_finite(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

json_t *json_flag(bool value)
{
    return json_boolean(value);
}

json_t *json_itself(json_t *value)
{
    return value;
}

json_t *json_of(const JsonField *fields, size_t count)
{
    bool ok = true;
    json_t *object = json_object();
    for (size_t i = 0; i < count; i++)
        if (fields[i].name != NULL)
            ok = json_object_set_new(object, fields[i].name, fields[i].value) == 0 && ok;
    if (ok)
        return object;
    json_decref(object);
    return NULL;
}

// Returns the value at a path such as lights.0.name. Numbers are indices of arrays.
static const json_t *find_value(const json_t *value, char *path)
{
    for (const char *name; (name = strsep(&path, ".")) != NULL;)
        value = json_is_array(value) ? json_array_get(value, strtoul(name, NULL, 10))
                                     : json_object_get(value, name);
    return value;
}

// Prints a value in a format such as ".3f", "5.3f", ".3g", ".3g%" or, for arrays of reals, ".3v".
// Prints reals with at most `most` digits.
static void print_value(const json_t *value, const char *format, int most, FILE *stream)
{
    char *point, *kind;
    if (json_is_integer(value))
        fprintf(stream, "%" JSON_INTEGER_FORMAT, json_integer_value(value));
    if (json_is_string(value))
        print_text(stream, "%s", json_string_value(value));
    if (json_is_integer(value) || json_is_string(value))
        return;
    const int width = (int)strtol(format, &point, 10), given = (int)strtol(point + 1, &kind, 10);
    const int digits = given < most ? given : most;
    for (size_t i = 0; i < json_array_size(value); i++)
        fprintf(stream, "%s%.*g", i == 0 ? "(" : ", ", digits,
                json_real_value(json_array_get(value, i)) + 0.0); // -0 becomes 0
    const bool is_percent = kind[1] == '%';
    const double number = json_is_real(value) ? json_real_value(value) : INFINITY;
    if (json_is_array(value))
        fputs(")", stream);
    else
        fprintf(stream, *kind == 'f' ? "%*.*f" : "%*.*g", width, digits,
                is_percent ? 100 * number : number);
    fputs(is_percent ? " %" : "", stream);
}

void json_print_digits(const json_t *report, const char *text, int most, FILE *stream)
{
    char path[NAME_SIZE];
    if (json_is_null(report))
        return;
    for (const char *open; *(open = text + strcspn(text, "{")) != '\0';) {
        const size_t length = strcspn(open + 1, " }");
        const char *format = open + 1 + length;
        fwrite(text, 1, (size_t)(open - text), stream);
        snprintf(path, sizeof path, "%.*s", (int)length, open + 1);
        print_value(find_value(report, path), format + 1, most, stream);
        text = strchr(format, '}') + 1;
    }
    fputs(text, stream);
}

void json_print(const json_t *report, const char *text, FILE *stream)
{
    json_print_digits(report, text, INT_MAX, stream);
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
