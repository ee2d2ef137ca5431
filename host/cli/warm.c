// SPDX-License-Identifier: MIT
// clrt warm [SCENE]: compiles the general kernels and, if a scene is given, kernels specialized for
// the scene. With a scene, "--tune specialize=always" omits the general kernels, and
// "specialize=never" omits the specialized kernels.
#include "cli/commands.h"
#include "cli/stages.h"

#include <stdio.h>

static bool warm_kernel(Session *session, const Options *options, const SceneTraits *traits,
                        const char *name, Error *error)
{
    const RendererUse use = {.entry = picture_entry(&options->picture)};
    const Kernel *kernel = session_kernel(session, &use, traits, error);
    if (kernel != NULL && !options->quiet)
        printf("%s kernels, %s, %s nodes, %s: %s %.2f s\n", name,
               kernel_family_name(kernel->choice.family), kernel_nodes_name(kernel->choice.nodes),
               kernel_precision_name(kernel->choice.precision),
               kernel->was_compiled ? "already compiled, ready in" : "compiled in",
               kernel->seconds);
    return kernel != NULL;
}

ExitCode warm_kernels(const Options *options, Session *session, Scene *scene, Error *error)
{
    StageSeconds unused = {0};
    const bool has_scene = options->scene_path != NULL, counts = options->picture.statistics;
    stage_begin(session, options);
    if (has_scene && !stage_load(session, scene, options, &unused, error))
        return EXIT_SCENE;
    if (!session_await(session, NULL, error))
        return EXIT_DEVICE;
    const SceneForm *form = has_scene ? stage_build(session, options, error) : NULL;
    if (has_scene && form == NULL)
        return EXIT_SCENE;
    const SceneTraits plain = {.statistics = counts};
    const SceneTraits special = has_scene ? traits_of(&form->flat, counts) : plain;
    const SceneTraits general = traits_general(special);
    if ((!has_scene || options->renderer.specialize != CLRT_SPECIALIZE_ALWAYS) &&
        !warm_kernel(session, options, &general, "general", error))
        return EXIT_DEVICE;
    if (!has_scene || options->renderer.specialize == CLRT_SPECIALIZE_NEVER)
        return EXIT_DONE;
    return warm_kernel(session, options, &special, "special", error) ? EXIT_DONE : EXIT_DEVICE;
}
