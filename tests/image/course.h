// SPDX-License-Identifier: MIT
// Finds the course's scenes, which are not part of clrt. The environment variable CLRT_COURSE names
// the course's folder. The default is a folder beside the sources.
#pragma once

#include <stdbool.h>

#define COURSE_PATH_SIZE 4096

// Writes the path of scenes/NAME.
void course_path(char path[COURSE_PATH_SIZE], const char *name);

// Returns whether the file exists. If not, prints a skip message.
bool course_has(const char *path);

// Returns whether scenes/models was made (CLRT_WITH_MODELS). If not, prints a skip message.
bool models_are_made(void);
