// SPDX-License-Identifier: MIT
// Tests the quotas of control groups with imitations of the system's file tree.
#include "base/processors.h"
#include "unit/cmocka_all.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define FILES 3

typedef struct {
    const char *path, *text; // path below the tree's root
} File;

static void write_file(const char *root, File file)
{
    char path[256];
    snprintf(path, sizeof path, "%s/%s", root, file.path);
    for (char *slash = path + strlen(root) + 1; (slash = strchr(slash, '/')) != NULL; slash++) {
        *slash = '\0';
        mkdir(path, 0777);
        *slash = '/';
    }
    FILE *stream = fopen(path, "w");
    assert_non_null(stream);
    fputs(file.text, stream);
    fclose(stream);
}

static uint32_t processors_of(const char *membership, const File files[FILES])
{
    char root[] = "/tmp/clrt-cgroup-XXXXXX", path[64], command[64];
    assert_non_null(mkdtemp(root));
    write_file(root, (File){"membership", membership});
    for (int i = 0; i < FILES && files[i].path != NULL; i++)
        write_file(root, files[i]);
    snprintf(path, sizeof path, "%s/membership", root);
    snprintf(command, sizeof command, "rm -r %s", root);
    const uint32_t processors = cgroup_processors(path, root);
    assert_int_equal(system(command), 0);
    return processors;
}

#define V1(folder, quota)                                                                          \
    {folder "/cpu.cfs_quota_us", quota "\n"},                                                      \
    {                                                                                              \
        folder "/cpu.cfs_period_us", "100000\n"                                                    \
    }

static const struct {
    const char *membership;
    File files[FILES];
    uint32_t processors;
} cases[] = {
    // Version 2: quotas are rounded up. The smallest quota among the group and its parents applies.
    {"0::/job\n", {{"job/cpu.max", "250000 100000\n"}}, 3},
    {"0::/slice/job\n",
     {{"slice/job/cpu.max", "max 100000\n"},
      {"slice/cpu.max", "200000 100000\n"},
      {"cpu.max", "800000 100000\n"}},
     2},
    {"0::/job\n", {{"job/cpu.max", "max 100000\n"}}, UINT32_MAX},
    // The group's path is relative to the host, but the mount starts at the container's group.
    {"0::/docker/0123456789abcdef\n", {{"cpu.max", "100000 100000\n"}}, 1},
    // Version 1: only the controller "cpu" limits the processors.
    {"4:cpu:/job\n", {V1("cpu/job", "-1")}, UINT32_MAX},
    {"9:memory:/other\n4:cpu:/job\n0::/\n", {V1("cpu/job", "150000")}, 2},
    {"4:cpu,cpuacct:/job\n", {V1("cpu,cpuacct/job", "50000")}, 1},
    {"4:cpuset:/job\n", {V1("cpuset/job", "100000")}, UINT32_MAX},
    // Nonsense is no quota.
    {"nonsense\n0:\n\n0::/job\n",
     {{"job/cpu.max", "100000 0\n"}, {"cpu.max", "many\n"}},
     UINT32_MAX},
};

TEST(quotas_of_both_versions_limit_the_processors)
{
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_int_equal(processors_of(cases[i].membership, cases[i].files), cases[i].processors);
    assert_int_equal(cgroup_processors("/nowhere", "/nowhere"), UINT32_MAX);
}
