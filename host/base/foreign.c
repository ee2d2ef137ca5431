// SPDX-License-Identifier: MIT
// Finds clrt-foreign, starts it by posix_spawn, collects its output through a socket, and kills it
// if it exceeds a limit of time or size. clrt-foreign limits its memory by itself
// (host/foreign/process_limits.c).
//
// Invariant: when foreign_run returns, the process of clrt-foreign has ended. A crash, an endless
// loop or endless output of clrt-foreign becomes an error message.
#include "base/foreign.h"

#include "base/array.h"
#include "base/clock.h"

#include <dlfcn.h>
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

// Stores the path of `name` in the folder of the absolute path `file`. Returns whether this path
// can be read.
static bool find_beside(char path[COMPANION_PATH_SIZE], const char *file, const char *name)
{
    const char *slash = strrchr(file, '/');
    if (file[0] != '/' || slash == NULL)
        return false;
    snprintf(path, COMPANION_PATH_SIZE, "%.*s%s", (int)(slash - file) + 1, file, name);
    return access(path, R_OK) == 0;
}

bool foreign_companion(char path[COMPANION_PATH_SIZE], const char *name, const char *installed)
{
    static const char here[] = "";
    char program[PATH_MAX] = "";
    Dl_info own = {.dli_fname = ""};
    if (readlink("/proc/self/exe", program, sizeof program - 1) < 0)
        program[0] = '\0';
    dladdr(here, &own);
    path[0] = '\0';
    return find_beside(path, program, name) || find_beside(path, program, installed) ||
           find_beside(path, own.dli_fname, name);
}

// Searches as foreign_companion does, and falls back to the absolute installation folder.
static void find_program(char path[COMPANION_PATH_SIZE])
{
    if (!foreign_companion(path, "clrt-foreign", CLRT_FOREIGN_FOLDER "/clrt-foreign"))
        snprintf(path, COMPANION_PATH_SIZE, "%s/clrt-foreign", CLRT_FOREIGN_INSTALLED);
}

#define PIECE ((size_t)1 << 16) // minimum free bytes in the buffer before each read

// Returns the environment with which this process was started, or an empty one if /proc is missing.
// Reading environ would be unsafe, because OpenCL drivers call setenv in other threads. The strings
// of the result are in *bytes. The caller frees the result and *bytes.
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

// A running program, and the parent's end of the socket to it.
typedef struct {
    pid_t id;
    int socket;
} Child;

// Starts the program words[0]. The program's standard output is the socket, and its standard input
// and error are /dev/null.
static bool start(Child *child, const char *const words[], Error *cause)
{
    int ends[2]; // the parent's end of the socket, and the child's end
    File bytes = {0};
    int fault = socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) == 0 ? 0 : errno;
    if (fault == 0) {
        char **environment = environment_at_start(&bytes, cause);
        fault = environment == NULL ? ENOMEM
                                    : spawn(&child->id, (char *const *)words, environment, ends[1]);
        free(environment);
        file_free(&bytes);
        close(ends[1]);
        child->socket = ends[0];
        if (fault != 0)
            close(ends[0]);
    }
    return fault == 0 ||
           error_set(cause, "%s, which reads it, cannot be started: %s", words[0], strerror(fault));
}

static bool fail_late(const ForeignReader *reader, Error *cause)
{
    return error_set(cause, "%s took too long to read it and was stopped", reader->library);
}

// Waits until the socket has data or is closed. Fails at the deadline.
static bool await(int socket, double deadline, const ForeignReader *reader, Error *cause)
{
    for (;;) {
        const double left = deadline - clock_seconds();
        struct pollfd wanted = {.fd = socket, .events = POLLIN};
        if (left <= 0)
            return fail_late(reader, cause);
        const int found = poll(&wanted, 1, left > 1000 ? 1000000 : (int)(left * 1000) + 1);
        if (found > 0)
            return true;
        if (found < 0 && errno != EINTR)
            return error_set(cause, "the output of %s cannot be read", reader->library);
    }
}

// Reads the output until the child closes the socket.
static bool read_all(File *output, int socket, const ForeignReader *reader, Error *cause)
{
    const double deadline = clock_seconds() + reader->seconds;
    void *memory = NULL;
    size_t capacity = 0;
    for (;;) {
        const bool has_room = array_reserve(&memory, &capacity, output->size + PIECE, 1, cause);
        output->bytes = memory;
        if (!has_room || !await(socket, deadline, reader, cause))
            return false;
        const ssize_t got = read(socket, output->bytes + output->size, capacity - output->size);
        if (got == 0)
            return true;
        if (got < 0 && errno != EINTR)
            return error_set(cause, "the output of %s cannot be read", reader->library);
        output->size += got > 0 ? (size_t)got : 0;
        if (output->size > reader->bytes)
            return error_set(cause, "%s exceeded the limit of its output and was stopped",
                             reader->library);
    }
}

// Kills the child, unless it has already ended. Returns its status from waitpid.
static int end(const Child *child)
{
    int status = 0;
    kill(child->id, SIGKILL);
    while (waitpid(child->id, &status, 0) < 0 && errno == EINTR)
        continue;
    close(child->socket);
    return status;
}

static bool judge(int status, const ForeignReader *reader, Error *cause)
{
    const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    if (signal == SIGALRM || signal == SIGXCPU)
        return fail_late(reader, cause);
    if (signal != 0)
        return error_set(cause, "%s crashed while reading it (signal %d)", reader->library, signal);
    return (WIFEXITED(status) && WEXITSTATUS(status) == 0) ||
           error_set(cause, "clrt-foreign, which reads it, ended too early");
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
    Child child;
    *stream = (File){0};
    if (reader->program == NULL)
        find_program(found);
    const char *all[1 + FOREIGN_WORDS + 1] = {reader->program != NULL ? reader->program : found};
    memcpy(all + 1, words, FOREIGN_WORDS * sizeof *words);
    if (!start(&child, all, cause))
        return false;
    const bool is_whole = read_all(stream, child.socket, reader, cause);
    const int status = end(&child);
    return is_whole && judge(status, reader, cause);
}
