// SPDX-License-Identifier: MIT
// The number of processors, and how many of them the process may use.
#pragma once

#include <stdint.h>

uint32_t processors_present(void);

// Returns the number allowed by the calling thread's affinity and by its control groups' quotas.
uint32_t processors_usable(void);

// Returns the least quota of a control group and its ancestors, in processors, rounded up, or
// UINT32_MAX without a quota. Handles cgroup versions 1 and 2. membership is /proc/self/cgroup and
// mount is /sys/fs/cgroup, except in tests.
uint32_t cgroup_processors(const char *membership, const char *mount);
