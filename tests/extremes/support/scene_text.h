// SPDX-License-Identifier: MIT
// Scenes as users write them.
#pragma once

#include "scene/scene.h"

// Parses text, which is right.
Scene scene_text_parse(const char *text);

// Counts those of the texts, the last of which is NULL, that are not refused with a message that
// names line and column, and reports them.
size_t scene_text_report(const char *test, const char *details, const char *const *texts);
