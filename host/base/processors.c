// SPDX-License-Identifier: MIT
// Queries the system at every call, because affinity and quotas can change while a process runs.
#include "base/processors.h"

#include "base/cgroup.h"

#include <sched.h>
#include <unistd.h>

uint32_t processors_present(void)
{
    const long count = sysconf(_SC_NPROCESSORS_ONLN);
    return count > 0 ? (uint32_t)count : 1;
}

// Returns the number of processors in the affinity mask. sched_getaffinity fails if cpu_set_t is
// too small for the machine; then all processors count.
static uint32_t allowed_processors(void)
{
    cpu_set_t set;
    const uint32_t present = processors_present();
    if (sched_getaffinity(0, sizeof set, &set) != 0)
        return present;
    const uint32_t allowed = (uint32_t)CPU_COUNT(&set);
    return allowed < present ? allowed : present;
}

uint32_t processors_usable(void)
{
    const uint32_t allowed = allowed_processors();
    const uint32_t granted = cgroup_processors("/proc/self/cgroup", "/sys/fs/cgroup");
    return granted < allowed ? granted : allowed;
}
