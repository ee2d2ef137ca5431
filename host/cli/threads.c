// SPDX-License-Identifier: MIT
// PoCL 3.1 and 6.0 read different variables; both are set.
#include "cli/threads.h"

#include "cli/cgroup.h"

#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static uint32_t present_processors(void)
{
    const long count = sysconf(_SC_NPROCESSORS_ONLN);
    return count > 0 ? (uint32_t)count : 1;
}

// The set fails where there are more processors than it holds.
static uint32_t allowed_processors(void)
{
    cpu_set_t set;
    const uint32_t present = present_processors();
    if (sched_getaffinity(0, sizeof set, &set) != 0)
        return present;
    const uint32_t allowed = (uint32_t)CPU_COUNT(&set);
    return allowed < present ? allowed : present;
}

static uint32_t usable_processors(void)
{
    const uint32_t allowed = allowed_processors();
    const uint32_t granted = cgroup_processors("/proc/self/cgroup", "/sys/fs/cgroup");
    return granted < allowed ? granted : allowed;
}

uint32_t threads_allowed(uint32_t count)
{
    return count > 0 ? count : usable_processors();
}

void threads_limit(uint32_t count)
{
    char text[16];
    const uint32_t usable = usable_processors();
    if (count == 0 && usable >= present_processors())
        return;
    snprintf(text, sizeof text, "%u", count > 0 ? count : usable);
    setenv("POCL_MAX_PTHREAD_COUNT", text, count > 0);
    setenv("POCL_CPU_MAX_CU_COUNT", text, count > 0);
}
