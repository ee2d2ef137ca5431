// SPDX-License-Identifier: MIT
// Finds the number of processors that the process may use: the size of the affinity mask, limited
// by the quotas of control groups. Containers use such quotas. Every call queries the system,
// because affinity and quotas can change while a process runs.
#include "base/processors.h"

#include <math.h>
#include <sched.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

// In cgroup version 2, /proc/self/cgroup has one line "0::/path", and a group's limit on processors
// is in its file cpu.max. In version 1, each controller has a line such as "4:cpu,cpuacct:/path",
// and a group's quota and period are in two files. A container mounts only its own group and the
// groups below, so the path may not exist below the mount. clrt therefore reads the limits in every
// parent folder up to the mount.

#define PATH_SIZE 4096

static bool read_numbers(const char *folder, const char *name, int count, double *numbers)
{
    char path[2 * PATH_SIZE + 32];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "r");
    if (file == NULL)
        return false;
    const int found = count == 2 ? fscanf(file, "%lf %lf", &numbers[0], &numbers[1])
                                 : fscanf(file, "%lf", &numbers[0]);
    fclose(file);
    return found == count;
}

// Returns the group's quota in processors, rounded up. Returns UINT32_MAX if the group has no
// quota, or if the quota is "max" or -1.
static uint32_t group_grant(const char *folder)
{
    double time[2]; // quota and period
    if (!read_numbers(folder, "cpu.max", 2, time) &&
        !(read_numbers(folder, "cpu.cfs_quota_us", 1, &time[0]) &&
          read_numbers(folder, "cpu.cfs_period_us", 1, &time[1])))
        return UINT32_MAX;
    const double processors = ceil(time[0] / time[1]);
    return processors >= 1 && processors < 65536 ? (uint32_t)processors : UINT32_MAX;
}

static uint32_t least_grant(const char *mount, const char *group)
{
    char folder[2 * PATH_SIZE];
    uint32_t least = UINT32_MAX;
    const size_t root = strlen(mount);
    snprintf(folder, sizeof folder, "%s%s", mount, group);
    for (;;) {
        const uint32_t grant = group_grant(folder);
        if (grant < least)
            least = grant;
        char *slash = strrchr(folder + root, '/');
        if (slash == NULL)
            return least;
        *slash = '\0';
    }
}

static bool names_cpu(char *controllers)
{
    for (char *name; (name = strsep(&controllers, ",")) != NULL;)
        if (strcmp(name, "cpu") == 0)
            return true;
    return false;
}

// Returns the least quota of a version 1 group and its ancestors. The name of the controller's
// folder is "cpu" or a list of controllers, such as "cpu,cpuacct".
static uint32_t controller_grant(const char *mount, char *controllers, const char *group)
{
    char folder[PATH_SIZE];
    uint32_t least = UINT32_MAX;
    char names[2][128] = {"cpu", ""};
    snprintf(names[1], sizeof names[1], "%s", controllers);
    if (!names_cpu(controllers))
        return least;
    for (int i = 0; i < 2; i++) {
        snprintf(folder, sizeof folder, "%s/%s", mount, names[i]);
        const uint32_t grant = least_grant(folder, group);
        if (grant < least)
            least = grant;
    }
    return least;
}

uint32_t cgroup_processors(const char *membership, const char *mount)
{
    char line[PATH_SIZE];
    uint32_t least = UINT32_MAX;
    FILE *file = fopen(membership, "r");
    if (file == NULL)
        return least;
    while (fgets(line, sizeof line, file) != NULL) {
        line[strcspn(line, "\n")] = '\0';
        char *group = line;
        strsep(&group, ":");
        char *controllers = strsep(&group, ":");
        if (group == NULL)
            continue;
        const uint32_t grant = controllers[0] == '\0' ? least_grant(mount, group)
                                                      : controller_grant(mount, controllers, group);
        if (grant < least)
            least = grant;
    }
    fclose(file);
    return least;
}

uint32_t processors_present(void)
{
    const long count = sysconf(_SC_NPROCESSORS_ONLN);
    return count > 0 ? (uint32_t)count : 1;
}

// Returns the number of processors in the affinity mask. If cpu_set_t is too small for the machine,
// sched_getaffinity fails. The result is then the number of all processors.
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
