// SPDX-License-Identifier: MIT
#include "image/course.h"

#include "unit/cmocka_all.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

void course_path(char path[COURSE_PATH_SIZE], const char *name)
{
    const char *folder = getenv("CLRT_COURSE");
    snprintf(path, COURSE_PATH_SIZE, "%s/scenes/%s", folder != NULL ? folder : CLRT_COURSE, name);
}

bool course_has(const char *path)
{
    if (access(path, R_OK) == 0)
        return true;
    print_message("skipped: the course's file %s is missing (CLRT_COURSE names its folder)\n",
                  path);
    return false;
}

bool models_are_made(void)
{
    if (access(CLRT_SOURCE_FOLDER "/scenes/models/creature.ply", R_OK) == 0)
        return true;
    print_message("skipped: scenes/models was not made (CLRT_WITH_MODELS)\n");
    return false;
}
