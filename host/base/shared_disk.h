// SPDX-License-Identifier: MIT
// Folders that several machines may use at once.
#pragma once

#include <stdbool.h>

// Returns whether several hosts can mount a file system of this type, f_type of statfs, at once.
// FUSE counts as shared, because sshfs and GlusterFS use it.
bool disk_type_is_shared(unsigned long type);

// Returns whether the folder lies on a file system that hosts can share; false if statfs fails.
bool disk_is_shared(const char *folder);
