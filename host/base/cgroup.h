// SPDX-License-Identifier: MIT
// A control group's files -> how many processors' worth of time it grants.
#pragma once

#include <stdint.h>

// Rounded up, the least of the group's own and those above it, of version 2 or 1; UINT32_MAX where
// none is set.  membership is /proc/self/cgroup and mount /sys/fs/cgroup, but for tests.
uint32_t cgroup_processors(const char *membership, const char *mount);
