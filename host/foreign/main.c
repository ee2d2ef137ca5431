// SPDX-License-Identifier: MIT
// The program clrt-foreign. `clrt-foreign MODEL` reads a model with Assimp. `clrt-foreign PICTURE
// FORMAT MODULE` reads a picture with OpenImageIO. Both write records (base/foreign.h) to standard
// output. Only clrt and its library run this program.
#include "foreign/picture.h"
#include "foreign/process_limits.h"
#include "foreign/send.h"

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#ifdef CLRT_WITH_ASSIMP
#include "foreign/model.h"

// Sends the model. Puts "./" in front of a relative path, so that Assimp searches the model's
// folder for companion files.
static bool send_model(FILE *stream, const char *name, Error *error)
{
    Files files;
    char *path = file_path_beside("./", name, error);
    if (path == NULL)
        return false;
    limits_take_model();
    files_init(&files, path);
    return model_send(stream, &files, error);
}
#else
static bool send_model(FILE *stream, const char *name, Error *error)
{
    (void)stream, (void)name;
    return error_set(error, "this build reads only PLY meshes, because it lacks Assimp; add it: "
                            "tools/setup meshes && tools/render SCENE");
}
#endif

// Redirects standard output to /dev/null, because importers print to it. Returns a stream for the
// original standard output.
static FILE *take_output(void)
{
    const int own = dup(STDOUT_FILENO);
    const int nothing = open("/dev/null", O_WRONLY);
    dup2(nothing, STDOUT_FILENO);
    return own >= 0 ? fdopen(own, "wb") : NULL;
}

int main(int count, char **arguments)
{
    Error error = {0};
    limits_take();
    FILE *stream = take_output();
    if (stream == NULL || (count != 2 && count != 4))
        return EXIT_FAILURE;
    if (count == 2 ? !send_model(stream, arguments[1], &error)
                   : !picture_send(stream, arguments + 1, &error))
        send_text(stream, FOREIGN_FAILURE, "%s", error.text);
    // The end of the process closes the stream.
    _exit(fflush(stream) == 0 ? EXIT_SUCCESS : EXIT_FAILURE);
}
