// SPDX-License-Identifier: MIT
// Detects folders that several machines may use at once. Locks may not work between machines.
#pragma once

#include <stdbool.h>

// Returns whether several machines can mount a file system of this type at once. type is f_type of
// statfs. FUSE counts as shared, because sshfs and GlusterFS use it.
bool disk_type_is_shared(unsigned long type);

// Returns whether machines can share the folder's file system. Returns false if statfs fails.
bool disk_is_shared(const char *folder);
