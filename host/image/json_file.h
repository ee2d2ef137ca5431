// SPDX-License-Identifier: MIT
// Reports as JSON and as text. A report is described once, by a list of fields, which becomes a
// JSON object. The report's text comes from a template that names fields of this object, so text
// and JSON always agree.
#pragma once

#include "base/error.h"

#include <jansson.h>
#include <stdint.h>
#include <stdio.h>

// Returns `path` as a JSON string, or a JSON null if `path` is NULL. If `path` is not UTF-8, '?'
// replaces all bytes beyond ASCII.
json_t *json_file_path(const char *path);

json_t *json_count(uint64_t count);
json_t *json_two(uint32_t one, uint32_t other);

// Returns a JSON null if `value` is not finite, because JSON has no infinity.
json_t *json_finite(double value);

json_t *json_flag(bool value);
json_t *json_itself(json_t *value);

typedef struct {
    const char *name;
    json_t *value; // a new reference, which json_of takes over
} JsonField;

// Makes a field from a value of any of these types.
#define FIELD(name, value)                                                                         \
    ((JsonField){name, _Generic((value),                                                           \
                     bool: json_flag,                                                              \
                     uint32_t: json_count,                                                         \
                     uint64_t: json_count,                                                         \
                     double: json_finite,                                                          \
                     char *: json_file_path,                                                       \
                     const char *: json_file_path,                                                 \
                     json_t *: json_itself)(value)})

// A field that the object has only if the condition holds. Otherwise, `value` is not evaluated.
#define FIELD_IF(condition, name, value)                                                           \
    ((condition) ? FIELD(name, value) : (JsonField){NULL, NULL})

// Returns an object with these fields, or NULL if memory runs out.
#define JSON(...)                                                                                  \
    json_of((const JsonField[]){__VA_ARGS__},                                                      \
            sizeof((const JsonField[]){__VA_ARGS__}) / sizeof(JsonField))
json_t *json_of(const JsonField *fields, size_t count);

// Returns a whole report: the versions of its schema and of clrt, and the given fields.
#define REPORT(schema, ...)                                                                        \
    JSON(FIELD("schema", json_integer(schema)), FIELD("version", CLRT_VERSION), __VA_ARGS__)

// Prints `text`, and replaces its placeholders by the report's values: {GROUP.NAME} for integers
// and strings, {NAME .3f} or {NAME .3g} for reals, {NAME .3g%} for shares in percent, and {NAME
// .3v} for arrays of reals. A null value prints as infinity. A null report prints nothing.
void json_print(const json_t *report, const char *text, FILE *stream);

// Prints as json_print does, but reals with at most `most` digits.
void json_print_digits(const json_t *report, const char *text, int most, FILE *stream);

// Writes `root` with sorted keys to `path` ("-": standard output), and releases `root`.
bool json_file_write(json_t *root, const char *path, Error *error);
