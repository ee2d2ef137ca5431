// SPDX-License-Identifier: MIT
// Compiles the general kernels and, with a scene, its specialized kernels. With a scene,
// "--tune specialize=always" omits the general kernels, and "specialize=never" the
// specialized ones.
#include "cli/commands.h"

#include <stdio.h>

static bool warm_kernel(Run *run, const SceneTraits *traits, const char *name, Error *error)
{
    const PictureGoal goal = request_goal(&run->options->picture);
    const RendererUse use = {.entry = picture_entry(&goal)};
    const Kernel *kernel = session_kernel(&run->session, &use, traits, error);
    if (kernel != NULL && !run->options->quiet)
        printf("%s kernels, %s, %s nodes, %s: %s %.2f s\n", name,
               kernel_family_name(kernel->choice.family), kernel_nodes_name(kernel->choice.nodes),
               kernel_precision_name(kernel->choice.precision),
               kernel->was_compiled ? "already compiled, ready in" : "compiled in",
               kernel->seconds);
    return kernel != NULL;
}

ExitCode warm_kernels(Run *run, Error *error)
{
    const Options *options = run->options;
    const bool has_scene = options->scene_path != NULL;
    run_begin(&run->session, options);
    if (has_scene && !run_load_scene(run, error))
        return EXIT_SCENE;
    if (!run_await_device(run, error))
        return EXIT_DEVICE;
    if (has_scene && !run_build_scene(run, error))
        return EXIT_SCENE;
    const SceneTraits general = traits_general(options->picture.statistics);
    if ((!has_scene || options->renderer.specialize != CLRT_SPECIALIZE_ALWAYS) &&
        !warm_kernel(run, &general, "general", error))
        return EXIT_DEVICE;
    if (!has_scene || options->renderer.specialize == CLRT_SPECIALIZE_NEVER)
        return EXIT_DONE;
    const SceneTraits special = traits_of(&run->form->flat, options->picture.statistics);
    return warm_kernel(run, &special, "special", error) ? EXIT_DONE : EXIT_DEVICE;
}
