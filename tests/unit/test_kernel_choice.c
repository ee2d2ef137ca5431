// SPDX-License-Identifier: MIT
// Tests that each OpenCL implementation gets the fastest form of the kernels, unless the user
// chooses, and that small pictures get kernels that compile faster. The tests need no device.
#include "device/kernel_choice.h"
#include "render/sampler.h"
#include "render/tile_pass.h"
#include "session/costs.h"
#include "session/picture.h"
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
        const KernelChoice choice = kernel_choice_make(&cases[i].wanted, &cases[i].device);
        assert_int_equal(choice.family, cases[i].family);
        assert_int_equal(choice.nodes, cases[i].nodes);
        assert_int_equal(choice.precision, cases[i].wanted.precision);
    }
}

// A picture, the programs that are compiled already, and whether the picture gets quick kernels.
// The device has one compute unit.
typedef struct {
    uint32_t width, height, samples;
    ClrtPicture wanted;
    const KernelEntry *packets, *pairs; // entries with compiled packets or pair kernels
    bool is_quick;
} Case;

static const Case *current;

// The linker replaces calls of program_is_compiled by this function.
bool __wrap_program_is_compiled(const ProgramSource *source);
bool __wrap_program_is_compiled(const ProgramSource *source)
{
    const bool is_packet = source->choice.family == FAMILY_PACKET;
    return source->entry == (is_packet ? current->packets : current->pairs);
}

static bool gets_quick_kernels(const Case *wanted, ClrtSettings settings, uint32_t triangles)
{
    Error error;
    MeshObject object = {.mesh.triangle_count = triangles};
    const Scene scene = {.objects = {.data = &object, .count = 1}};
    const SessionPicture request = {
        .settings = {.width = wanted->width, .height = wanted->height, .samples = wanted->samples},
        .wanted = wanted->wanted};
    const SessionWork work = session_picture_work(&request, 1);
    Session session = {.settings.wanted = settings,
                       .device.facts.compute_units = 1,
                       .choice = {FAMILY_PACKET, NODES_WIDE, 0, CLRT_FP32},
                       .scene.scene = &scene};
    session.kernels.source = (ProgramSource){.device = &session.device, .cache = &session.cache};
    current = wanted;
    assert_true(session_await(&session, &work, &error));
    assert_int_equal(session.choice.family, session.is_quick ? FAMILY_RAY : FAMILY_PACKET);
    assert_int_equal(session.choice.nodes, session.is_quick ? NODES_PAIR : NODES_WIDE);
    return session.is_quick;
}

TEST(small_pictures_get_kernels_that_compile_faster_until_packets_are_compiled)
{
    static const Case pictures[] = {
        {48, 32, 1, .is_quick = true},
        {48, 32, 1, .wanted.statistics = true},
        {48, 32, 1, .packets = &draw_entry},
        {48, 32, 1, .packets = &sample_entry, .is_quick = true},
        {1450, 1450, .samples = 1},
        {1450, 1450, 1, .pairs = &draw_entry, .is_quick = true},
        {725, 725, 2, .pairs = &sample_entry},
        {2100, 2100, 1, .pairs = &draw_entry},
        {200, 150, 1, .wanted.contrast = 0.5, .is_quick = true},
        {400, 300, 1, .wanted.contrast = 0.0005},
        {48, 32, 1, .wanted.error = 0.05, .is_quick = true},
        {48, 32, 1, .wanted.error = 0.05, .packets = &ladder_entry},
        {480, 320, 1, .wanted.error = 0.001},
        {48, 32, 1, .wanted.seconds = 0.1, .is_quick = true},
        {48, 32, 1, .wanted.seconds = 3},
    };
    for (size_t i = 0; i < sizeof pictures / sizeof *pictures; i++)
        if (gets_quick_kernels(&pictures[i], (ClrtSettings){0}, 0) != pictures[i].is_quick)
            fail_msg("picture %zu", i);
    assert_true(gets_quick_kernels(&pictures[0], (ClrtSettings){0}, QUICK_TRIANGLES - 1));
    assert_false(gets_quick_kernels(&pictures[0], (ClrtSettings){0}, QUICK_TRIANGLES));
}

TEST(settings_that_name_kernels_are_kept)
{
    static const Case small = {48, 32, 1, .is_quick = true};
    assert_false(gets_quick_kernels(&small, (ClrtSettings){.kernel = CLRT_KERNEL_PACKET}, 0));
    assert_false(gets_quick_kernels(&small, (ClrtSettings){.tree = CLRT_TREE_NONE}, 0));
    const ClrtSettings special = {.specialize = CLRT_SPECIALIZE_ALWAYS};
    assert_false(gets_quick_kernels(&small, special, 0));
}
