// SPDX-License-Identifier: MIT
// Files called "extremes.scn", so that messages begin with that.
#include "scene_text.h"

#include "check.h"
#include "report.h"
#include "scene/scn.h"

#include <string.h>

#define NAME "extremes.scn"

Scene scene_text_parse(const char *text)
{
    Scene scene;
    Error error = {0};
    require(scn_parse(&scene, text, strlen(text), NAME, &error), &error);
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

size_t scene_text_report(const char *test, const char *details, const char *const *texts)
{
    size_t count = 0, accepted = 0;
    for (; texts[count] != NULL; count++)
        if (!is_refused(texts[count])) {
            print_message("accepted, or refused without a place: %s\n", texts[count]);
            accepted++;
        }
    return report_case(test, details, count, accepted);
}
