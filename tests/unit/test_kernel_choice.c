// SPDX-License-Identifier: MIT
// Tests that each OpenCL implementation gets the fastest form of the kernels, unless the user
// chooses.
#include "device/kernel_choice.h"
#include "unit/cmocka_all.h"

static void assert_choice(const KernelRequest *request, const Device *device, KernelFamily family,
                          NodeLayout nodes)
{
    const KernelChoice choice = kernel_choose(request, device);
    assert_int_equal(choice.family, family);
    assert_int_equal(choice.nodes, nodes);
}

TEST(cpus_get_packets_unless_their_implementation_is_slow_with_them)
{
    const KernelRequest none = {0};
    const Device pocl = {.platform = "Portable Computing Language", .is_cpu = true};
    const Device other = {.platform = "Oclgrind", .is_cpu = true};
    const Device intel = {.platform = "Intel(R) OpenCL", .is_cpu = true};
    const Device mesa = {.platform = "rusticl", .is_cpu = true};
    assert_choice(&none, &pocl, FAMILY_PACKET, NODES_WIDE);
    assert_choice(&none, &other, FAMILY_PACKET, NODES_WIDE);
    assert_choice(&none, &intel, FAMILY_RAY, NODES_PAIR);
    assert_choice(&none, &mesa, FAMILY_RAY, NODES_PAIR);
}

TEST(other_devices_get_rays)
{
    const KernelRequest none = {0};
    const Device pocl = {.platform = "Portable Computing Language"};
    const Device mesa = {.platform = "rusticl"};
    assert_choice(&none, &pocl, FAMILY_RAY, NODES_PAIR);
    assert_choice(&none, &mesa, FAMILY_RAY, NODES_PAIR);
}

TEST(a_choice_by_the_user_is_kept)
{
    const Device mesa = {.platform = "rusticl", .is_cpu = true};
    const KernelRequest packets = {.family = 1 + FAMILY_PACKET};
    const KernelRequest wide = {.nodes = 1 + NODES_WIDE};
    assert_int_equal(kernel_choose(&packets, &mesa).family, FAMILY_PACKET);
    assert_int_equal(kernel_choose(&packets, &mesa).nodes, NODES_WIDE);
    assert_int_equal(kernel_choose(&wide, &mesa).family, FAMILY_RAY);
    assert_int_equal(kernel_choose(&wide, &mesa).nodes, NODES_WIDE);
}

TEST(fp64_is_rays_over_pairs_everywhere)
{
    const Device pocl = {.platform = "Portable Computing Language", .is_cpu = true};
    const KernelRequest fp64 = {.precision = PRECISION_FP64};
    assert_choice(&fp64, &pocl, FAMILY_RAY, NODES_PAIR);
    assert_int_equal(kernel_choose(&fp64, &pocl).precision, PRECISION_FP64);
}
