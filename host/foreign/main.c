// SPDX-License-Identifier: MIT
// clrt-foreign PATH: reads one model with Assimp and writes it to standard output in the format of
// mesh/foreign_stream.h. Only clrt and its library run this program.
#include "foreign/model.h"

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

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
    Files files;
    Error error = {0};
    if (count != 2)
        return EXIT_FAILURE;
    limits_take();
    FILE *stream = take_output();
    if (stream == NULL)
        return EXIT_FAILURE;
    // The path always includes a folder, so that Assimp searches that folder for companion files.
    char *path = file_path_beside("./", arguments[1], &error);
    if (path == NULL)
        return EXIT_FAILURE;
    files_init(&files, path);
    if (!model_send(stream, &files, &error))
        send_text(stream, FOREIGN_FAILURE, "%s", error.text);
    // The end of the process closes the stream.
    _exit(fflush(stream) == 0 ? EXIT_SUCCESS : EXIT_FAILURE);
}
