// SPDX-License-Identifier: MIT
// Preload this so that clrt finds every folder on NFS.
#include <sys/vfs.h>

int statfs(const char *path, struct statfs *disk)
{
    (void)path;
    *disk = (struct statfs){.f_type = 0x6969};
    return 0;
}
