// SPDX-License-Identifier: MIT
// clrt SCENE: passes the command line's settings to the window. Builds without a window compile
// only the stubs at the end.
#include "cli/commands.h"

#ifdef CLRT_WITH_WINDOW
#include "base/file.h"
#include "cli/stages.h"
#include "view/controls.h"
#include "view/viewer.h"

#include <math.h>

// After the window is closed, the process waits at most this many seconds for the worker thread to
// end. The thread may be compiling, which takes longer. Builds with sanitizers free everything at
// the end, so they wait for the compilation.
#define PATIENCE (CLRT_TIDY_EXIT ? 10 : 1)

void show_write_keys(FILE *stream)
{
    controls_write_help(stream);
}

ExitCode show_scene(const Options *options, Session *session, Scene *scene, Error *error)
{
    (void)scene; // the window reads the scene itself
    static const ExitCode codes[] = {[VIEWER_CLOSED] = EXIT_DONE,
                                     [VIEWER_NO_WINDOW] = EXIT_USAGE,
                                     [VIEWER_NO_SCENE] = EXIT_SCENE,
                                     [VIEWER_NO_DEVICE] = EXIT_DEVICE};
    const ViewerSettings settings = {
        .scene_path = options->scene_path,
        .load = options->load,
        .view = options->picture.view,
        .width = options->picture.width,
        .height = options->picture.height,
        .samples = options->picture.samples > 1 ? options->picture.samples : 2,
        .smooth = options->picture.samples != 1,
        .uses_bvh = options->renderer.tree != CLRT_TREE_NONE,
        .encoding = options->encoding,
        .exposure = (int)lround(2 * options->exposure),
        .worker = {.session = stage_settings(options),
                   .cache = session->cache,
                   .max_level = options->picture.max_level},
        .keys = options->keys,
        .statistics = options->picture.statistics,
        .verbose = options->verbose,
        .patience = PATIENCE};
    // This check comes before the window opens, because a missing scene must be reported even
    // without a display.
    if (!file_check(options->scene_path, error))
        return EXIT_SCENE;
    bool is_stopped;
    const ViewerEnd end = viewer_run(&settings, &is_stopped, error);
    // The worker thread may still compile, and PoCL then needs the private folder. The next process
    // of clrt removes the folder.
    if (!is_stopped)
        session->cache.private_folder[0] = '\0';
    return codes[end];
}
#else
void show_write_keys(FILE *stream)
{
    (void)stream;
}

ExitCode show_scene(const Options *options, Session *session, Scene *scene, Error *error)
{
    (void)options, (void)session, (void)scene;
    error_set(error, "this build has no window");
    return EXIT_USAGE;
}
#endif
