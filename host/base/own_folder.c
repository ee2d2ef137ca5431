// SPDX-License-Identifier: MIT
// Links to the program are followed: its companion files are beside the file itself.
#include "base/own_folder.h"

#include <string.h>
#include <unistd.h>

bool own_folder(char folder[PATH_MAX])
{
    const ssize_t length = readlink("/proc/self/exe", folder, PATH_MAX - 1);
    if (length <= 0)
        return false;
    folder[length] = '\0';
    char *slash = strrchr(folder, '/');
    if (slash == NULL)
        return false;
    slash[slash == folder] = '\0'; // the root remains
    return true;
}
