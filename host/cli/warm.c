// SPDX-License-Identifier: MIT
// Compiles the general kernels and, with a scene, its specialized kernels. With a scene,
// "--specialize always" omits the general and "--specialize never" the specialized kernels.
#include "cli/commands.h"

#include <stdio.h>

static bool warm_kernel(Run *run, const SceneTraits *traits, const char *name, Error *error)
{
    ReadyKernel ready;
    const AsyncDevice *async = &run->async_device;
    const uint32_t group[2] = {run->settings.group_width, run->settings.group_height};
    const KernelChoice *choice = &async->setup.source.choice;
    if (!ready_kernel_make(&ready, &async->setup, traits, group, error))
        return false;
    if (!run->options->quiet)
        printf("%s kernels, %s, %s nodes, %s: %s %.2f s\n", name,
               kernel_family_name(choice->family), kernel_nodes_name(choice->nodes),
               kernel_precision_name(choice->precision),
               ready.was_compiled ? "already compiled, ready in" : "compiled in", ready.seconds);
    ready_kernel_free(&ready);
    return true;
}

ExitCode warm_kernels(Run *run, Error *error)
{
    const Options *options = run->options;
    const bool has_scene = options->scene_path != NULL;
    run_begin(run);
    if (has_scene && !run_load_scene(run, error))
        return EXIT_SCENE;
    if (!run_await_device(run, error))
        return EXIT_DEVICE;
    if (has_scene && !run_build_scene(run, error))
        return EXIT_SCENE;
    const SceneTraits general = traits_general(options->statistics);
    if ((!has_scene || options->specialization != SPECIALIZE_ALWAYS) &&
        !warm_kernel(run, &general, "general", error))
        return EXIT_DEVICE;
    if (!has_scene || options->specialization == SPECIALIZE_NEVER)
        return EXIT_DONE;
    const SceneTraits special = traits_of(&run->flat, options->statistics);
    return warm_kernel(run, &special, "special", error) ? EXIT_DONE : EXIT_DEVICE;
}
