// SPDX-License-Identifier: MIT
// Finds and runs clrt-foreign, and limits its time and the size of its output. clrt-foreign limits
// its memory by itself (host/foreign/process_limits.c).
#include "base/foreign.h"

#include <dlfcn.h>
#include <errno.h>
#include <string.h>
#include <unistd.h>

static const char library_place[] = "";

static bool name_beside_library(char path[COMPANION_PATH_SIZE])
{
    Dl_info own;
    // Rejects a relative path, because the current folder may contain anybody's files.
    if (dladdr(library_place, &own) == 0 || own.dli_fname[0] != '/')
        return false;
    const int length = (int)(strrchr(own.dli_fname, '/') - own.dli_fname);
    snprintf(path, COMPANION_PATH_SIZE, "%.*s/clrt-foreign", length, own.dli_fname);
    return true;
}

// Searches near the running program, then beside clrt's library, then in the installation folder.
// Programs that use the library, such as Python, need the last two places.
static bool find_program(char path[COMPANION_PATH_SIZE], Error *cause)
{
    if ((file_companion(path, "clrt-foreign", CLRT_FOREIGN_FOLDER) && access(path, X_OK) == 0) ||
        (name_beside_library(path) && access(path, X_OK) == 0))
        return true;
    snprintf(path, COMPANION_PATH_SIZE, "%s/clrt-foreign", CLRT_FOREIGN_INSTALLED);
    return access(path, X_OK) == 0 ||
           error_set(cause, "%s, which reads it, cannot be started: %s", path, strerror(errno));
}

static bool judge(ChildFate fate, int signal, const char *library, Error *cause)
{
    switch (fate) {
    case CHILD_DONE:
        return true;
    case CHILD_LATE:
        return error_set(cause, "%s took too long to read it and was stopped", library);
    case CHILD_LONG:
        return error_set(cause, "%s exceeded the limit of its output and was stopped", library);
    case CHILD_LOST:
        return error_set(cause, "the output of %s cannot be read", library);
    case CHILD_CRASHED:
        return error_set(cause, "%s crashed while reading it (signal %d)", library, signal);
    case CHILD_FAILED:
        break;
    }
    return error_set(cause, "clrt-foreign, which reads it, ended too early");
}

void foreign_make_printable(char *text, size_t size, char substitute)
{
    for (size_t i = 0; i < size; i++)
        if (text[i] < ' ' || text[i] > '~')
            text[i] = substitute;
}

bool foreign_run(File *stream, const ForeignReader *reader, const char *const words[FOREIGN_WORDS],
                 Error *cause)
{
    char found[COMPANION_PATH_SIZE];
    Error reason = {0};
    ChildProcess child;
    int signal;
    *stream = (File){0};
    if (reader->program == NULL && !find_program(found, cause))
        return false;
    const char *all[1 + FOREIGN_WORDS + 1] = {reader->program != NULL ? reader->program : found};
    memcpy(all + 1, words, FOREIGN_WORDS * sizeof *words);
    if (!child_spawn(&child, all, &reason))
        return error_set(cause, "%s, which reads it, cannot be started: %s", all[0], reason.text);
    const ChildFate fate = child_collect(&child, &reader->limits, stream, &signal, cause);
    return judge(fate, signal, reader->library, cause);
}
