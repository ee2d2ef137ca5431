// SPDX-License-Identifier: MIT
// Tests which file systems count as shared between machines.
#include "base/shared_disk.h"
#include "unit/cmocka_all.h"

#include <linux/magic.h>

TEST(disks_on_a_network_are_shared)
{
    static const unsigned long types[] = {NFS_SUPER_MAGIC, CIFS_SUPER_MAGIC, SMB2_SUPER_MAGIC,
                                          CEPH_SUPER_MAGIC, FUSE_SUPER_MAGIC};
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        assert_true(disk_type_is_shared(types[i]));
    assert_true(disk_type_is_shared((unsigned long)(int32_t)CIFS_SUPER_MAGIC)); // f_type is signed
}

TEST(disks_of_one_machine_are_not)
{
    static const unsigned long types[] = {EXT4_SUPER_MAGIC, XFS_SUPER_MAGIC, BTRFS_SUPER_MAGIC,
                                          TMPFS_MAGIC, OVERLAYFS_SUPER_MAGIC};
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        assert_false(disk_type_is_shared(types[i]));
    assert_false(disk_is_shared("/proc"));
    assert_false(disk_is_shared("/nonexistent"));
}
