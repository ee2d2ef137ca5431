// SPDX-License-Identifier: MIT
// Tests that each OpenCL implementation gets the fastest form of the kernels, unless the user
// chooses.
#include "device/kernel_choice.h"
#include "unit/cmocka_all.h"

static const struct {
    ClrtSettings wanted;
    Device device;
    KernelFamily family;
    NodeLayout nodes;
} cases[] = {
    // CPUs get packets unless their implementation is slow with them.
    {{0},
     {.facts.platform = "Portable Computing Language", .is_cpu = true},
     FAMILY_PACKET,
     NODES_WIDE},
    {{0}, {.facts.platform = "Oclgrind", .is_cpu = true}, FAMILY_PACKET, NODES_WIDE},
    {{0}, {.facts.platform = "Intel(R) OpenCL", .is_cpu = true}, FAMILY_RAY, NODES_PAIR},
    {{0}, {.facts.platform = "rusticl", .is_cpu = true}, FAMILY_RAY, NODES_PAIR},
    // Other devices get rays.
    {{0}, {.facts.platform = "Portable Computing Language"}, FAMILY_RAY, NODES_PAIR},
    {{0}, {.facts.platform = "rusticl"}, FAMILY_RAY, NODES_PAIR},
    // The user's choice is kept. fp64 always means rays and pair nodes.
    {{.kernel = CLRT_KERNEL_PACKET},
     {.facts.platform = "rusticl", .is_cpu = true},
     FAMILY_PACKET,
     NODES_WIDE},
    {{.kernel = CLRT_KERNEL_WIDE},
     {.facts.platform = "rusticl", .is_cpu = true},
     FAMILY_RAY,
     NODES_WIDE},
    {{.kernel = CLRT_KERNEL_PAIR},
     {.facts.platform = "Oclgrind", .is_cpu = true},
     FAMILY_RAY,
     NODES_PAIR},
    {{.precision = CLRT_FP64},
     {.facts.platform = "Portable Computing Language", .is_cpu = true},
     FAMILY_RAY,
     NODES_PAIR},
};

TEST(each_device_gets_its_fastest_form_unless_the_user_chooses)
{
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const KernelChoice choice = kernel_choose(&cases[i].wanted, &cases[i].device);
        assert_int_equal(choice.family, cases[i].family);
        assert_int_equal(choice.nodes, cases[i].nodes);
        assert_int_equal(choice.precision, cases[i].wanted.precision);
    }
}
