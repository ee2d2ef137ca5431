// SPDX-License-Identifier: MIT
// Only the program reads "-" as standard input: to whoever uses the library it is a file's name.
#include "cli/scene_source.h"

#include "scene/scn.h"

#include <string.h>

// What messages call it; having no slash, it has its meshes looked for in the current folder.
#define INPUT_NAME "standard input"

typedef bool Take(Scene *, const File *, const char *, Error *);

static bool take_input(Scene *scene, Take *take, Error *error)
{
    File file;
    const bool ok =
        file_read_stream(&file, stdin, INPUT_NAME, error) && take(scene, &file, INPUT_NAME, error);
    file_free(&file);
    return ok;
}

bool scene_source_load(Scene *scene, const Options *options, Error *error)
{
    return options_read_input(options) ? take_input(scene, scn_take, error)
                                       : scn_load(scene, options->scene_path, error);
}

bool scene_source_load_tolerantly(Scene *scene, const Options *options, Error *error)
{
    return options_read_input(options) ? take_input(scene, scn_take_tolerantly, error)
                                       : scn_load_tolerantly(scene, options->scene_path, error);
}
