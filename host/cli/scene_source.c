// SPDX-License-Identifier: MIT
// Only the program reads "-" as standard input.  The library treats it as a file name.
#include "cli/scene_source.h"

#include "scene/scn.h"

// The name used in messages.  Without a slash, it makes meshes relative to the current folder.
#define INPUT_NAME "standard input"

bool scene_source_load(Scene *scene, const Options *options, PlyParse *parse, Error *error)
{
    File file;
    if (!options_read_input(options))
        return scn_load(scene, options->scene_path, parse, error);
    const bool ok = file_read_stream(&file, stdin, INPUT_NAME, error) &&
                    scn_take(scene, &file, INPUT_NAME, parse, error);
    file_free(&file);
    return ok;
}
