// SPDX-License-Identifier: MIT
// Parses scene text in tests. Paths in the text are relative to the folder scenes/.
#pragma once

#include "scene/scn.h"
#include "unit/cmocka_all.h"

#include <stdio.h>
#include <string.h>

static inline bool parse(Scene *scene, const char *text, Error *error)
{
    return scn_parse(scene, text, strlen(text), CLRT_SOURCE_FOLDER "/scenes/inline.scn", error);
}

// Returns the scene of a valid text. Invalid text fails the test.
static inline Scene parsed(const char *text)
{
    Scene scene;
    Error error = {0};
    if (!parse(&scene, text, &error))
        fail_msg("%s\n%s", error.text, text);
    return scene;
}

// Formats the text like printf, and returns its scene.
__attribute__((format(printf, 1, 2))) static inline Scene parsed_format(const char *format, ...)
{
    char text[1024];
    va_list arguments;
    va_start(arguments, format);
    const int length = vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    assert_in_range(length, 0, sizeof text - 1);
    return parsed(text);
}
