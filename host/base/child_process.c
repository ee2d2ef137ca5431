// SPDX-License-Identifier: MIT
// Starts a child by posix_spawn, collects its output through a socket, and kills the child at a
// limit of time or size (ChildLimits).
//
// Invariant: when child_end returns, the child has ended. All faults of a child, such as crashes,
// endless loops or endless output, become a ChildFate in the parent.
#include "base/child_process.h"

#include "base/array.h"
#include "base/clock.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#define PIECE ((size_t)1 << 16) // bytes; minimum free space before each read

// Returns the environment with which this process was started, or an empty one if /proc is missing.
// Reading environ would be unsafe, because OpenCL drivers call setenv in other threads. The strings
// of the result are in *bytes. The caller frees both.
static char **environment_at_start(File *bytes, Error *cause)
{
    Error unused = {0};
    size_t count = 0;
    if (!file_read(bytes, "/proc/self/environ", &unused))
        *bytes = (File){0};
    for (size_t i = 0; i < bytes->size; i++)
        count += bytes->bytes[i] == '\0';
    char **list = memory_zeroed(count + 1, sizeof *list, cause);
    char *next = bytes->bytes;
    for (size_t i = 0; list != NULL && i < count; i++, next += strlen(next) + 1)
        list[i] = next;
    return list;
}

static int spawn(pid_t *id, char *const words[], char *const environment[], int output)
{
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    sigset_t none, ordinary;
    sigemptyset(&none);
    sigemptyset(&ordinary);
    sigaddset(&ordinary, SIGALRM);
    sigaddset(&ordinary, SIGPIPE);
    posix_spawn_file_actions_init(&actions);
    posix_spawnattr_init(&attributes);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &ordinary);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    const int fault = posix_spawn(id, words[0], &actions, &attributes, words, environment);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    return fault;
}

bool child_spawn(ChildProcess *child, const char *const words[], Error *cause)
{
    int ends[2]; // the parent's end of the socket, and the child's
    pid_t id = 0;
    File bytes;
    *child = (ChildProcess){0};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
        return error_set(cause, "%s", strerror(errno));
    char **environment = environment_at_start(&bytes, cause);
    const int fault =
        environment == NULL ? ENOMEM : spawn(&id, (char *const *)words, environment, ends[1]);
    free(environment);
    file_free(&bytes);
    close(ends[1]);
    if (fault == 0)
        *child = (ChildProcess){id, ends[0]};
    else
        close(ends[0]);
    return fault == 0 || error_set(cause, "%s", strerror(fault));
}

int child_end(ChildProcess *child)
{
    int status = 0;
    if (child->id <= 0)
        return status;
    kill(child->id, SIGKILL);
    while (waitpid(child->id, &status, 0) < 0 && errno == EINTR)
        continue;
    close(child->socket);
    *child = (ChildProcess){0};
    return status;
}

// Returns CHILD_DONE when the socket has data or is closed, CHILD_LATE at the deadline, and
// CHILD_LOST if poll fails.
static ChildFate await(int socket, double deadline)
{
    for (;;) {
        const double left = deadline - clock_seconds();
        struct pollfd wanted = {.fd = socket, .events = POLLIN};
        if (left <= 0)
            return CHILD_LATE;
        const int found = poll(&wanted, 1, left > 1000 ? 1000000 : (int)(left * 1000) + 1);
        if (found > 0)
            return CHILD_DONE;
        if (found < 0 && errno != EINTR)
            return CHILD_LOST;
    }
}

static ChildFate read_all(File *output, int socket, const ChildLimits *limits, Error *error)
{
    const double deadline = clock_seconds() + limits->seconds;
    void *memory = NULL;
    size_t capacity = 0;
    for (;;) {
        const bool has_room = array_reserve(&memory, &capacity, output->size + PIECE, 1, error);
        output->bytes = memory;
        const ChildFate fate = has_room ? await(socket, deadline) : CHILD_LOST;
        if (fate != CHILD_DONE)
            return fate;
        const ssize_t got = read(socket, output->bytes + output->size, capacity - output->size);
        if (got == 0)
            return CHILD_DONE;
        if (got < 0 && errno != EINTR)
            return CHILD_LOST;
        output->size += got > 0 ? (size_t)got : 0;
        if (output->size > limits->bytes)
            return CHILD_LONG;
    }
}

ChildFate child_collect(ChildProcess *child, const ChildLimits *limits, File *output, int *signal,
                        Error *error)
{
    *output = (File){0};
    const ChildFate fate = read_all(output, child->socket, limits, error);
    const int status = child_end(child);
    *signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    if (*signal == SIGALRM || *signal == SIGXCPU)
        return CHILD_LATE;
    if (fate != CHILD_DONE)
        return fate;
    if (*signal != 0)
        return CHILD_CRASHED;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? CHILD_DONE : CHILD_FAILED;
}
