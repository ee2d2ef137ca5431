// SPDX-License-Identifier: MIT
// File systems that several machines mount at once.
#pragma once

#include <stdbool.h>

// Returns whether statfs reports such a file system as f_type. FUSE counts, because it may be one.
bool disk_type_is_shared(unsigned long type);

// Returns whether the folder lies on such a file system; false if the system does not know.
bool disk_is_shared(const char *folder);
