// SPDX-License-Identifier: MIT
// Tests the quotas of control groups in file trees like the system's.
#include "base/processors.h"
#include "unit/cmocka_all.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

typedef struct {
    char root[64];
    char membership[128];
} Tree;

static void write_file(const Tree *tree, const char *name, const char *text)
{
    char path[256];
    snprintf(path, sizeof path, "%s/%s", tree->root, name);
    for (char *slash = strchr(path + strlen(tree->root) + 1, '/'); slash != NULL;
         slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        mkdir(path, 0777);
        *slash = '/';
    }
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static Tree make_tree(const char *membership)
{
    Tree tree = {.root = "/tmp/clrt-cgroup-XXXXXX"};
    assert_non_null(mkdtemp(tree.root));
    snprintf(tree.membership, sizeof tree.membership, "%s/membership", tree.root);
    write_file(&tree, "membership", membership);
    return tree;
}

static uint32_t processors_of(const Tree *tree)
{
    char command[128];
    const uint32_t processors = cgroup_processors(tree->membership, tree->root);
    snprintf(command, sizeof command, "rm -r %s", tree->root);
    assert_int_equal(system(command), 0);
    return processors;
}

TEST(a_quota_of_version_2_is_rounded_up)
{
    const Tree tree = make_tree("0::/job\n");
    write_file(&tree, "job/cpu.max", "250000 100000\n");
    assert_int_equal(processors_of(&tree), 3);
}

TEST(the_least_of_all_groups_above_counts)
{
    const Tree tree = make_tree("0::/slice/job\n");
    write_file(&tree, "slice/job/cpu.max", "max 100000\n");
    write_file(&tree, "slice/cpu.max", "200000 100000\n");
    write_file(&tree, "cpu.max", "800000 100000\n");
    assert_int_equal(processors_of(&tree), 2);
}

TEST(no_quota_is_no_limit)
{
    Tree tree = make_tree("0::/job\n");
    write_file(&tree, "job/cpu.max", "max 100000\n");
    assert_int_equal(processors_of(&tree), UINT32_MAX);
    tree = make_tree("4:cpu:/job\n");
    write_file(&tree, "cpu/job/cpu.cfs_quota_us", "-1\n");
    write_file(&tree, "cpu/job/cpu.cfs_period_us", "100000\n");
    assert_int_equal(processors_of(&tree), UINT32_MAX);
    assert_int_equal(cgroup_processors("/nowhere", "/nowhere"), UINT32_MAX);
}

TEST(a_quota_of_version_1_counts)
{
    Tree tree = make_tree("9:memory:/other\n4:cpu:/job\n0::/\n");
    write_file(&tree, "cpu/job/cpu.cfs_quota_us", "150000\n");
    write_file(&tree, "cpu/job/cpu.cfs_period_us", "100000\n");
    assert_int_equal(processors_of(&tree), 2);
    tree = make_tree("4:cpu,cpuacct:/job\n");
    write_file(&tree, "cpu,cpuacct/job/cpu.cfs_quota_us", "50000\n");
    write_file(&tree, "cpu,cpuacct/job/cpu.cfs_period_us", "100000\n");
    assert_int_equal(processors_of(&tree), 1);
}

TEST(quotas_of_other_controllers_do_not_count)
{
    const Tree tree = make_tree("4:cpuset:/job\n");
    write_file(&tree, "cpuset/job/cpu.cfs_quota_us", "100000\n");
    write_file(&tree, "cpuset/job/cpu.cfs_period_us", "100000\n");
    assert_int_equal(processors_of(&tree), UINT32_MAX);
}

// The group's path is relative to the host, but the mount starts at the container's group.
TEST(a_container_finds_its_quota_at_the_mount)
{
    const Tree tree = make_tree("0::/docker/0123456789abcdef\n");
    write_file(&tree, "cpu.max", "100000 100000\n");
    assert_int_equal(processors_of(&tree), 1);
}

TEST(what_is_no_quota_is_passed_over)
{
    const Tree tree = make_tree("nonsense\n0:\n\n0::/job\n");
    write_file(&tree, "job/cpu.max", "100000 0\n");
    write_file(&tree, "cpu.max", "many\n");
    assert_int_equal(processors_of(&tree), UINT32_MAX);
}
