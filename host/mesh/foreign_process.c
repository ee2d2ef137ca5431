// SPDX-License-Identifier: MIT
// The program is executed, not only forked, because other threads of this process may hold any
// lock. It limits itself before it opens the file. This process limits the size and the time of
// its output.
#include "mesh/foreign_process.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

// Longer than the program's own limit: its message is better if it ends by its own alarm.
const ForeignReader foreign_reader = {.limits = {.seconds = 125, .bytes = (size_t)8 << 30}};

#ifdef CLRT_FOREIGN_FOLDER
// Programs that use clrt's library find it in the configured installation folder.
static bool find_program(char path[COMPANION_PATH_SIZE], const char *model, Error *error)
{
    if (file_companion(path, "clrt-foreign", CLRT_FOREIGN_FOLDER) && access(path, X_OK) == 0)
        return true;
    snprintf(path, COMPANION_PATH_SIZE, "%s/clrt-foreign", CLRT_FOREIGN_INSTALLED);
    return access(path, X_OK) == 0 ||
           error_set(error, "%s: %s, which reads it, cannot be started: %s", model, path,
                     strerror(errno));
}
#else
static bool find_program(char path[COMPANION_PATH_SIZE], const char *model, Error *error)
{
    (void)path;
    return error_set(error, "%s: this build reads only PLY meshes, because it lacks Assimp", model);
}
#endif

static bool judge(ChildFate fate, int signal, const char *model, Error *error)
{
    switch (fate) {
    case CHILD_DONE:
        return true;
    case CHILD_LATE:
        return error_set(error, "%s: Assimp took too long to read it and was stopped", model);
    case CHILD_LONG:
        return error_set(error, "%s: Assimp exceeded the limit of its output and was stopped",
                         model);
    case CHILD_LOST:
        return error_set(error, "%s: the output of Assimp cannot be read", model);
    case CHILD_CRASHED:
        return error_set(error, "%s: Assimp crashed while reading it (signal %d)", model, signal);
    case CHILD_FAILED:
        break;
    }
    return error_set(error, "%s: the program that reads it ended too early", model);
}

bool foreign_process_run(File *stream, const ForeignReader *reader, const char *path, Error *error)
{
    char found[COMPANION_PATH_SIZE];
    Error cause = {0};
    ChildProcess child;
    int signal;
    *stream = (File){0};
    if (reader->program == NULL && !find_program(found, path, error))
        return false;
    const char *program = reader->program != NULL ? reader->program : found;
    if (!child_spawn(&child, program, path, &cause))
        return error_set(error, "%s: %s, which reads it, cannot be started: %s", path, program,
                         cause.text);
    const ChildFate fate = child_collect(&child, &reader->limits, stream, &signal, error);
    const bool ok = judge(fate, signal, path, error);
    if (!ok)
        file_free(stream);
    return ok;
}
