// SPDX-License-Identifier: MIT
// PoCL 3.1 and 6.0 read different variables; both are set.
#include "cli/threads.h"

#include <sched.h>
#include <stdio.h>
#include <stdlib.h>

static uint32_t allowed_processors(void)
{
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) != 0)
        return UINT32_MAX;
    return (uint32_t)CPU_COUNT(&set);
}

// Processors' worth of time that the control group grants, rounded up.
static uint32_t granted_processors(void)
{
    double quota, period;
    FILE *file = fopen("/sys/fs/cgroup/cpu.max", "r");
    if (file == NULL)
        return UINT32_MAX;
    const int found = fscanf(file, "%lf %lf", &quota, &period);
    fclose(file);
    if (found != 2 || !(period > 0) || !(quota > 0))
        return UINT32_MAX;
    return quota / period < 4096 ? (uint32_t)(quota / period + 0.999) : UINT32_MAX;
}

uint32_t threads_allowed(uint32_t count)
{
    const uint32_t allowed = allowed_processors(), granted = granted_processors();
    const uint32_t usable = allowed < granted ? allowed : granted;
    return count > 0 ? count : usable < UINT32_MAX ? usable : 1;
}

void threads_limit(uint32_t count)
{
    char text[16];
    const uint32_t granted = granted_processors();
    if (count == 0 && granted >= allowed_processors())
        return;
    snprintf(text, sizeof text, "%u", count > 0 ? count : granted);
    setenv("POCL_MAX_PTHREAD_COUNT", text, count > 0);
    setenv("POCL_CPU_MAX_CU_COUNT", text, count > 0);
}
