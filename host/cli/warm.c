// SPDX-License-Identifier: MIT
// clrt warm [SCENE]: compiles the general kernels and, if a scene is given, kernels specialized for
// the scene. With a scene, "--tune specialize=always" omits the general kernels, and
// "specialize=never" omits the specialized kernels.
#include "cli/commands.h"
#include "cli/stages.h"

#include <stdio.h>

static bool save(Session *session, Error *error)
{
    const char *folder = session->cache.folder;
    if (folder[0] == '\0')
        return error_set(error, "no folder can store the compiled kernels: set POCL_CACHE_DIR");
    return session_save(session) || error_set(error,
                                              "%s: the compiled kernels cannot be stored: make "
                                              "room, or set POCL_CACHE_DIR to another folder",
                                              folder);
}

static ExitCode warm_kernel(Session *session, const Options *options, const SceneTraits *traits,
                            const char *name, Error *error)
{
    const RendererUse use = {.entry = picture_entry(&options->picture)};
    const Kernel *kernel = session_kernel(session, &use, traits, error);
    if (kernel == NULL)
        return EXIT_DEVICE;
    if (!options->quiet)
        printf("%s kernels, %s, %s nodes, %s: %s %.2f s\n", name,
               kernel_family_name(kernel->choice.family), kernel_nodes_name(kernel->choice.nodes),
               kernel_precision_name(kernel->choice.precision),
               kernel->was_compiled ? "already compiled, ready in" : "compiled in",
               kernel->seconds);
    return kernel->was_compiled || save(session, error) ? EXIT_DONE : EXIT_OUTPUT;
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
    ExitCode code = EXIT_DONE;
    if (!has_scene || options->renderer.specialize != CLRT_SPECIALIZE_ALWAYS)
        code = warm_kernel(session, options, &general, "general", error);
    if (code == EXIT_DONE && has_scene && options->renderer.specialize != CLRT_SPECIALIZE_NEVER)
        code = warm_kernel(session, options, &special, "special", error);
    return code;
}
