// SPDX-License-Identifier: MIT
// Starts a copy of this process. libclrt must not contain fork, so child_fork has its own file.
#include "base/child_process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <unistd.h>

static _Noreturn void run_fork(pid_t parent, int socket, ChildWork *work, const void *context)
{
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent)
        _exit(0);
    const int nothing = open("/dev/null", O_RDWR);
    dup2(nothing, STDIN_FILENO);
    dup2(nothing, STDOUT_FILENO);
    work(socket, context);
    _exit(0);
}

bool child_fork(ChildProcess *child, ChildWork *work, const void *context, Error *cause)
{
    int ends[2]; // the parent's and the child's
    const pid_t parent = getpid();
    *child = (ChildProcess){0};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
        return error_set(cause, "no sockets are left");
    const pid_t id = fork();
    if (id == 0) {
        close(ends[0]);
        run_fork(parent, ends[1], work, context);
    }
    close(ends[1]);
    if (id < 0) {
        close(ends[0]);
        return error_set(cause, "no process can be started");
    }
    *child = (ChildProcess){id, ends[0]};
    return true;
}
