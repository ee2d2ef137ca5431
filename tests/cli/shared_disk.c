// SPDX-License-Identifier: MIT
// If preloaded, makes every folder appear to be on NFS.
#include <sys/vfs.h>

int statfs(const char *path, struct statfs *disk)
{
    (void)path;
    *disk = (struct statfs){.f_type = 0x6969};
    return 0;
}
