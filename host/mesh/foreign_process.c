// SPDX-License-Identifier: MIT
// Runs clrt-foreign, and limits the time and size of its output. Uses posix_spawn instead of fork,
// because other threads may hold locks. The program limits its own resources.
#include "mesh/foreign_process.h"

#include "base/array.h"
#include "base/clock.h"
#include "base/own_folder.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#define PIECE ((size_t)1 << 16) // bytes; minimum free space before each read

// The time exceeds the program's own limit, so that normally the program's alarm ends the program
// first.
const ForeignReader foreign_reader = {.seconds = 125, .bytes = (size_t)8 << 30};

typedef enum { PIPE_READ, PIPE_WRITE } PipeEnd;

#ifdef CLRT_FOREIGN_FOLDER
// Finds clrt-foreign in this program's folder, as in a build tree, or in the installation folder
// for helper programs.
static bool find_beside(char *path, size_t size)
{
    char folder[PATH_MAX];
    if (!own_folder(folder))
        return false;
    snprintf(path, size, "%s/clrt-foreign", folder);
    if (access(path, X_OK) == 0)
        return true;
    snprintf(path, size, "%s/%s/clrt-foreign", folder, CLRT_FOREIGN_FOLDER);
    return access(path, X_OK) == 0;
}

// Other programs that use clrt's library find clrt-foreign in the configured installation folder.
static bool find_program(char *path, size_t size, const char *model, Error *error)
{
    if (find_beside(path, size))
        return true;
    snprintf(path, size, "%s/clrt-foreign", CLRT_FOREIGN_INSTALLED);
    return access(path, X_OK) == 0 ||
           error_set(error, "%s: %s, which reads it, cannot be started: %s", model, path,
                     strerror(errno));
}
#else
static bool find_program(char *path, size_t size, const char *model, Error *error)
{
    (void)path, (void)size;
    return error_set(error, "%s: this build reads only PLY meshes, because it lacks Assimp", model);
}
#endif

// Starts the program with the pipe as its output and no other inherited file. Returns 0 or an error
// number.
static int start(pid_t *child, const char *program, const char *model, const int ends[2])
{
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    sigset_t none, ordinary;
    char *const words[] = {(char *)program, (char *)model, NULL};
    sigemptyset(&none);
    sigemptyset(&ordinary);
    sigaddset(&ordinary, SIGALRM);
    sigaddset(&ordinary, SIGPIPE);
    posix_spawn_file_actions_init(&actions);
    posix_spawnattr_init(&attributes);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, ends[PIPE_WRITE], STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &ordinary);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    const int fault = posix_spawn(child, program, &actions, &attributes, words, environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    return fault;
}

typedef enum { STREAM_WHOLE, STREAM_LATE, STREAM_LONG, STREAM_LOST } StreamFate;

// Waits until the pipe has data or ends (STREAM_WHOLE), or until the deadline (STREAM_LATE).
static StreamFate await(int pipe, double deadline)
{
    for (;;) {
        const double left = deadline - clock_seconds();
        struct pollfd wanted = {.fd = pipe, .events = POLLIN};
        if (left <= 0)
            return STREAM_LATE;
        const int found = poll(&wanted, 1, left > 1000 ? 1000000 : (int)(left * 1000) + 1);
        if (found > 0)
            return STREAM_WHOLE;
        if (found < 0 && errno != EINTR)
            return STREAM_LOST;
    }
}

static StreamFate read_all(File *stream, int pipe, const ForeignReader *reader, Error *error)
{
    const double deadline = clock_seconds() + reader->seconds;
    void *memory = NULL;
    size_t capacity = 0;
    StreamFate fate = STREAM_WHOLE;
    for (;;) {
        if (!array_reserve(&memory, &capacity, stream->size + PIECE, 1, error))
            fate = STREAM_LOST;
        stream->bytes = memory;
        if (fate == STREAM_WHOLE)
            fate = await(pipe, deadline);
        if (fate != STREAM_WHOLE)
            return fate;
        const ssize_t got = read(pipe, stream->bytes + stream->size, capacity - stream->size);
        if (got == 0)
            return STREAM_WHOLE;
        if (got < 0 && errno != EINTR)
            return STREAM_LOST;
        stream->size += got > 0 ? (size_t)got : 0;
        if (stream->size > reader->bytes)
            return STREAM_LONG;
    }
}

// Kills the program and returns its wait status. After a complete stream, the program has usually
// exited already.
static int finish(pid_t child)
{
    int status = 0;
    kill(child, SIGKILL);
    while (waitpid(child, &status, 0) < 0 && errno == EINTR)
        continue;
    return status;
}

static bool judge(int status, StreamFate fate, const char *model, Error *error)
{
    const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    if (fate == STREAM_LATE || signal == SIGALRM || signal == SIGXCPU)
        return error_set(error, "%s: Assimp took too long to read it and was stopped", model);
    if (fate == STREAM_LONG)
        return error_set(error, "%s: Assimp exceeded the limit of its output and was stopped",
                         model);
    if (fate == STREAM_LOST)
        return error_set(error, "%s: the output of Assimp cannot be read", model);
    if (signal != 0)
        return error_set(error, "%s: Assimp crashed while reading it (signal %d)", model, signal);
    return (WIFEXITED(status) && WEXITSTATUS(status) == 0) ||
           error_set(error, "%s: the program that reads it ended too early", model);
}

static bool run(File *stream, const ForeignReader *reader, const char *program, const char *model,
                Error *error)
{
    int ends[2];
    pid_t child;
    if (pipe2(ends, O_CLOEXEC) != 0)
        return error_set(error, "%s: cannot be read: %s", model, strerror(errno));
    const int fault = start(&child, program, model, ends);
    close(ends[PIPE_WRITE]);
    bool ok = fault == 0;
    if (ok) {
        const StreamFate fate = read_all(stream, ends[PIPE_READ], reader, error);
        ok = judge(finish(child), fate, model, error);
    } else {
        error_set(error, "%s: %s, which reads it, cannot be started: %s", model, program,
                  strerror(fault));
    }
    close(ends[PIPE_READ]);
    return ok;
}

bool foreign_process_run(File *stream, const ForeignReader *reader, const char *path, Error *error)
{
    char program[2 * PATH_MAX];
    *stream = (File){0};
    if (reader->program == NULL && !find_program(program, sizeof program, path, error))
        return false;
    const bool ok =
        run(stream, reader, reader->program != NULL ? reader->program : program, path, error);
    if (!ok)
        file_free(stream);
    return ok;
}
