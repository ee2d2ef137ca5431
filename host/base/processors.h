// SPDX-License-Identifier: MIT
// The number of the machine's processors, and how many of them the process may use.
#pragma once

#include <stdint.h>

uint32_t processors_present(void);

// Returns the number of processors that the calling thread's affinity and its control groups allow.
uint32_t processors_usable(void);

// Returns the least quota of a control group and its ancestors, in processors, rounded up. Returns
// UINT32_MAX if there is no quota. Supports cgroup versions 1 and 2. Except in tests, `membership`
// is /proc/self/cgroup and `mount` is /sys/fs/cgroup.
uint32_t cgroup_processors(const char *membership, const char *mount);
