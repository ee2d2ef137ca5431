// SPDX-License-Identifier: MIT
// Ignores failures, because setting a limit only fails if the system already has a lower one.
#include "base/confinement.h"

#include <signal.h>
#include <stdio.h>
#include <sys/prctl.h>
#include <unistd.h>

void confine_resource(int resource, rlim_t most)
{
    const struct rlimit both = {most, most};
    setrlimit((__rlimit_resource_t)resource, &both);
}

void confine_process(unsigned seconds)
{
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
    confine_resource(RLIMIT_CPU, seconds);
    confine_resource(RLIMIT_FSIZE, 0);
    confine_resource(RLIMIT_CORE, 0);
    alarm(seconds);
}

rlim_t confine_mapped_memory(void)
{
    unsigned long pages = 0;
    FILE *stream = fopen("/proc/self/statm", "r");
    if (stream == NULL || fscanf(stream, "%lu", &pages) != 1)
        pages = 0;
    if (stream != NULL)
        fclose(stream);
    return (rlim_t)pages * (rlim_t)sysconf(_SC_PAGESIZE);
}
