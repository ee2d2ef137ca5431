// SPDX-License-Identifier: MIT
// Scenes from text, as users write them.
#pragma once

#include "outcome.h"
#include "scene/scene.h"

// Returns the scene of a valid text, which format and its arguments make.
__attribute__((format(printf, 1, 2))) Scene scene_text_parse(const char *format, ...);

// Parses texts that clrt must reject with the line and column of the fault. Returns how many it
// does not reject so. The last text is NULL.
Outcome scene_text_refusals(const char *test, const char *const *texts);
