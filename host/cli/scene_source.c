// SPDX-License-Identifier: MIT
// Only the program reads "-" as standard input: to whoever uses the library it is a file's name.
#include "cli/scene_source.h"

#include "scene/scn.h"

// What messages call it; having no slash, it has its meshes looked for in the current folder.
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
