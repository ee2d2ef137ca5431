// SPDX-License-Identifier: MIT
// Packets are compiled by the run that would lose as much without them, or after as much was lost.
#include "render/quick_kernel.h"

// Measured: what compiling takes; and on scenes of fewer triangles than these what packets save,
// of a core's time for each sample and as part of the time without them.
#define PACKET_COMPILE_SECONDS 1.25
#define QUICK_COMPILE_SECONDS  0.8
#define FEW_TRIANGLES          20000
#define SAVED_PER_SAMPLE       0.3e-6
#define SAVED_PART             0.75

// Kernels made as setup says, but others.
static RendererSetup setup_with(const RendererSetup *setup, KernelChoice choice)
{
    RendererSetup other = *setup;
    other.source.choice = choice;
    return other;
}

static void packet_key(const RendererSetup *setup, char key[PROGRAM_KEY_SIZE])
{
    const RendererSetup packets = setup_with(setup, (KernelChoice){FAMILY_PACKET, NODES_WIDE, 0, PRECISION_FP32});
    const SceneTraits traits = traits_general(false);
    program_key(setup->device, &packets.source, &traits, key);
}

static double seconds_lost(const RendererSetup *setup, const QuickKernelRun *run)
{
    char key[PROGRAM_KEY_SIZE];
    packet_key(setup, key);
    return run->samples * SAVED_PER_SAMPLE / setup->device->compute_units +
           cache_lost(setup->cache, key);
}

bool quick_kernel_choose(const RendererSetup *setup, const QuickKernelRun *run,
                         KernelChoice *choice)
{
    const SceneTraits traits = traits_general(false);
    const RendererSetup quick = setup_with(setup, (KernelChoice){FAMILY_RAY, NODES_PAIR, 0, PRECISION_FP32});
    // Kernels under development are never known to be compiled.
    if (setup->source.choice.family != FAMILY_PACKET || setup->source.kernel_folder != NULL ||
        run->triangles >= FEW_TRIANGLES || ready_kernel_is_compiled(setup, &traits))
        return false;
    const double saved = ready_kernel_is_compiled(&quick, &traits) ? 0 : QUICK_COMPILE_SECONDS;
    if (seconds_lost(setup, run) > PACKET_COMPILE_SECONDS - saved)
        return false;
    *choice = quick.source.choice;
    return true;
}

void quick_kernel_note(const RendererSetup *setup, double seconds)
{
    char key[PROGRAM_KEY_SIZE];
    packet_key(setup, key);
    cache_add_lost(setup->cache, key, SAVED_PART * seconds);
}
