// SPDX-License-Identifier: MIT
// Selects single rays instead of packets for runs so short that compiling packets would take longer
// than packets save.
#include "render/quick_kernel.h"

// Measured compile times in seconds, and the core seconds that packets save per sample in scenes
// with fewer than FEW_TRIANGLES triangles.
#define PACKET_COMPILE_SECONDS 1.25
#define QUICK_COMPILE_SECONDS  0.8
#define FEW_TRIANGLES          20000
#define SAVED_PER_SAMPLE       0.3e-6

// Returns a copy of setup with this kernel choice.
static RendererSetup setup_with(const RendererSetup *setup, KernelChoice choice)
{
    RendererSetup other = *setup;
    other.source.choice = choice;
    return other;
}

static double seconds_lost(const RendererSetup *setup, const QuickKernelRun *run)
{
    return run->samples * SAVED_PER_SAMPLE / setup->device->compute_units;
}

bool quick_kernel_choose(const RendererSetup *setup, const QuickKernelRun *run,
                         KernelChoice *choice)
{
    const SceneTraits traits = traits_general(false);
    const RendererSetup quick =
        setup_with(setup, (KernelChoice){FAMILY_RAY, NODES_PAIR, 0, PRECISION_FP32});
    // Kernels under development never count as compiled.
    if (setup->source.choice.family != FAMILY_PACKET || setup->source.kernel_folder != NULL ||
        run->triangles >= FEW_TRIANGLES || ready_kernel_is_compiled(setup, &traits))
        return false;
    const double saved = ready_kernel_is_compiled(&quick, &traits) ? 0 : QUICK_COMPILE_SECONDS;
    if (seconds_lost(setup, run) > PACKET_COMPILE_SECONDS - saved)
        return false;
    *choice = quick.source.choice;
    return true;
}
