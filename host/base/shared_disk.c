// SPDX-License-Identifier: MIT
// Compares the type of a file system with a list of network and cluster file systems.
#include "base/shared_disk.h"

#include <stddef.h>
#include <sys/vfs.h>

bool disk_type_is_shared(unsigned long type)
{
    static const unsigned long types[] = {
        0x6969,     // NFS
        0xff534d42, // CIFS
        0xfe534d42, // SMB 2 and 3
        0x517b,     // SMB
        0x0bd00bd0, // Lustre
        0x47504653, // GPFS
        0x19830326, // BeeGFS
        0x00c36400, // Ceph
        0x5346414f, // AFS
        0x6b414653, // kAFS
        0x20030528, // OrangeFS
        0xaad7aaea, // PanFS
        0x01021997, // 9P
        0x01161970, // GFS2
        0x7461636f, // OCFS2
        0x65735546, // FUSE: GlusterFS, sshfs
    };
    for (size_t i = 0; i < sizeof types / sizeof types[0]; i++)
        if (types[i] == (type & 0xffffffff))
            return true;
    return false;
}

bool disk_is_shared(const char *folder)
{
    struct statfs disk;
    return statfs(folder, &disk) == 0 && disk_type_is_shared((unsigned long)disk.f_type);
}
