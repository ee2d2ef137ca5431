// SPDX-License-Identifier: MIT
// Reads a control group's files and returns the processor time that they grant.
#pragma once

#include <stdint.h>

// Returns the least quota of the group and its ancestors, in processors, rounded up; UINT32_MAX
// without a quota. Handles versions 1 and 2. membership is /proc/self/cgroup and mount is
// /sys/fs/cgroup, except in tests.
uint32_t cgroup_processors(const char *membership, const char *mount);
