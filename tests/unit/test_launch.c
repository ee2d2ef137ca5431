// SPDX-License-Identifier: MIT
// Tests that the sizes of work-groups and launches fit the device.
#include "device/launch.h"
#include "unit/cmocka_all.h"

static const struct {
    LaunchFacts facts;
    uint32_t group[2], items;
} devices[] = {
    // On CPUs, the sizes depend only on the layout of nodes.
    {{.is_cpu = true, .compute_units = 8, .group_limit = 4096, .group_multiple = 8}, {8, 8}, 4096},
    {{.is_cpu = true, .compute_units = 2, .group_limit = 4, .group_multiple = 16}, {8, 8}, 4096},
    {{.is_cpu = true, .is_wide = true, .compute_units = 8}, {2, 2}, 4096},
    // Intel's integrated GPUs have small compute units.
    {{.compute_units = 24, .group_limit = 256, .group_multiple = 16}, {8, 8}, 196608},
    {{.compute_units = 96, .group_limit = 512, .group_multiple = 32}, {8, 8}, 786432},
    // NVIDIA's GPUs with 20 and 132 multiprocessors. Registers limit the second GPU's groups.
    {{.compute_units = 20, .group_limit = 1024, .group_multiple = 32}, {8, 8}, 163840},
    {{.compute_units = 132, .group_limit = 256, .group_multiple = 32}, {8, 8}, 1048576},
    // AMD's GPUs, Mali with small groups, and a device with groups of one work-item.
    {{.compute_units = 8, .group_limit = 256, .group_multiple = 64}, {8, 8}, 65536},
    {{.compute_units = 304, .group_limit = 256, .group_multiple = 128}, {16, 8}, 1048576},
    {{.compute_units = 4, .group_limit = 64, .group_multiple = 16}, {8, 8}, 32768},
    {{.compute_units = 4, .group_limit = 48, .group_multiple = 16}, {8, 4}, 32768},
    {{.compute_units = 1, .group_limit = 1, .group_multiple = 1}, {1, 1}, 8192},
    // A driver may report no facts, or absurd facts.
    {{.compute_units = 0}, {8, 8}, 8192},
    {{.compute_units = UINT32_MAX, .group_multiple = UINT32_MAX}, {16, 16}, 1048576},
};

TEST(groups_and_launches_fit_the_device)
{
    for (size_t i = 0; i < sizeof devices / sizeof devices[0]; i++) {
        const LaunchShape shape = launch_shape(&devices[i].facts);
        if (shape.group[0] != devices[i].group[0] || shape.group[1] != devices[i].group[1] ||
            shape.items != devices[i].items || shape.is_paced == devices[i].facts.is_cpu)
            fail_msg("device %zu: groups of %u x %u, launches of %u", i, shape.group[0],
                     shape.group[1], shape.items);
    }
}

// Returns the longest time of launches 2 to 100 in seconds. Each work-item takes `seconds`.
static double longest_launch(const LaunchShape *shape, double samples, double seconds)
{
    double longest = 0;
    uint32_t items = launch_first_items(shape, samples);
    for (int launch = 0; launch < 100; launch++) {
        assert_in_range(items, 1, shape->items);
        longest = launch > 0 && items * seconds > longest ? items * seconds : longest;
        items = launch_next_items(shape, items, items, items * seconds);
    }
    return longest;
}

TEST(launches_are_short_on_slow_devices_and_large_on_fast_ones)
{
    static const double seconds[] = {1e-9, 1e-7, 1e-5, 1e-3};
    for (size_t i = 0; i < sizeof devices / sizeof devices[0]; i++) {
        const LaunchShape shape = launch_shape(&devices[i].facts);
        for (size_t j = 0; shape.is_paced && j < sizeof seconds / sizeof seconds[0]; j++)
            assert_true(longest_launch(&shape, 1, seconds[j]) <= 0.04);
        const double fast = 1e-9 * shape.items;
        assert_true(!shape.is_paced || longest_launch(&shape, 1, 1e-9) >= fast);
    }
}

// After a launch of one second, the next launch takes 0.03 seconds at the same speed.
TEST(the_next_launch_follows_the_time_of_the_last)
{
    const LaunchShape shape = {.items = 1000000, .is_paced = true};
    assert_int_equal(launch_first_items(&shape, 1), 250000);
    assert_int_equal(launch_first_items(&shape, 4096), 61);
    assert_int_equal(launch_first_items(&shape, 1e9), 1);
    assert_int_equal(launch_next_items(&shape, 100000, 100000, 1), 3000);
    assert_int_equal(launch_next_items(&shape, 1, 1, 1), 1);
    assert_int_equal(launch_next_items(&shape, 1000, 1000, 0), 2000);
    assert_int_equal(launch_next_items(&shape, 900000, 10, 0), 1000000);
    // The last launch was limited to 1000 items, but had only 500.
    assert_int_equal(launch_next_items(&shape, 1000, 500, 0.02), 750);
}
