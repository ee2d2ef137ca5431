// SPDX-License-Identifier: MIT
// Parses texts under the name "extremes.scn", with which messages then begin.
#include "scene_text.h"

#include "scene/scn.h"

#include <string.h>

#define NAME "extremes.scn"

Scene scene_text_parse(const char *format, ...)
{
    char text[1024];
    Scene scene;
    Error error = {0};
    va_list arguments;
    va_start(arguments, format);
    const int length = vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    assert_in_range(length, 0, sizeof text - 1);
    require(scn_parse(&scene, text, (size_t)length, NAME, &error), &error);
    return scene;
}

static bool is_refused(const char *text)
{
    Scene scene;
    Error error = {0};
    unsigned line, column;
    if (scn_parse(&scene, text, strlen(text), NAME, &error)) {
        scene_free(&scene);
        return false;
    }
    return sscanf(error.text, NAME ":%u:%u: ", &line, &column) == 2;
}

Outcome scene_text_refusals(const char *test, const char *const *texts)
{
    Outcome outcome = {.test = test};
    for (; texts[outcome.count] != NULL; outcome.count++)
        if (!is_refused(texts[outcome.count])) {
            print_message("accepted, or rejected without a place: %s\n", texts[outcome.count]);
            outcome.failures[BY_CLRT]++;
        }
    return outcome;
}
