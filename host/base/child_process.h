// SPDX-License-Identifier: MIT
// Runs a program that may crash or hang as a child process. The parent reads the child's output
// from a socket, and survives every fault of the child.
#pragma once

#include "base/file.h"

#include <sys/types.h>

// {0} means no child.
typedef struct {
    pid_t id;
    int socket; // to the child
} ChildProcess;

// Starts the program words[0]. Its arguments are `words`, which NULL terminates. Its standard
// output is the socket, and its standard input and error are /dev/null. Its environment is the
// initial environment of this process. Any thread may call child_spawn, even while another thread
// changes the environment. On failure, returns false and stores the reason in *cause, without a
// file name.
bool child_spawn(ChildProcess *child, const char *const words[], Error *cause);

// Kills the child, unless it has already ended, and closes the socket. Returns the child's status
// from waitpid, or 0 if there is no child.
int child_end(ChildProcess *child);

typedef struct {
    double seconds; // of wall time
    size_t bytes;
} ChildLimits;

typedef enum {
    CHILD_DONE,
    CHILD_LATE,    // reached its own time limit or the parent's
    CHILD_LONG,    // wrote more than ChildLimits allows
    CHILD_LOST,    // the output could not be read
    CHILD_CRASHED, // ended by a signal
    CHILD_FAILED   // exited with a nonzero status
} ChildFate;

// Reads output until the child closes the socket or exceeds a limit, then ends the child. The
// caller frees output, also after a failure. *signal is the signal that ended the child, or 0.
// error receives a message only if memory runs out.
ChildFate child_collect(ChildProcess *child, const ChildLimits *limits, File *output, int *signal,
                        Error *error);
