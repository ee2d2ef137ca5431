// SPDX-License-Identifier: MIT
// Child processes run code that may crash or hang. The parent and a child communicate over a pair
// of sockets. The parent survives every fault of the child.
#pragma once

#include "base/file.h"

#include <stdint.h>
#include <sys/resource.h>
#include <sys/types.h>

// {0} means no child.
typedef struct {
    pid_t id;
    int socket; // to the child
} ChildProcess;

// Runs in the child. When it returns, the child exits.
typedef void ChildWork(int socket, const void *context);

// Starts a copy of this process, with /dev/null as standard input and output. The copy calls
// work(socket, context), and is killed when this process ends. Only main may call this, before
// other threads start. On failure, returns false and stores the reason without a file name.
bool child_fork(ChildProcess *child, ChildWork *work, const void *context, Error *cause);

// Starts a program with one argument. Its standard output is the socket, and its standard input and
// error are /dev/null. Its environment is the one with which this process was started. Any thread
// may call child_spawn, also while others change the environment. On failure, returns false, and
// *cause receives the reason without a file name.
bool child_spawn(ChildProcess *child, const char *program, const char *argument, Error *cause);

// Kills the child and closes the socket. A child that has ended by itself keeps its status.
// Returns the status that waitpid stores, or 0 if there is no child.
int child_end(ChildProcess *child);

// Send and receive whole messages. They return false if the other process has closed its socket.
bool child_send(int socket, const void *bytes, size_t size);
bool child_receive(int socket, void *bytes, size_t size);

typedef struct {
    double seconds; // of wall time
    size_t bytes;
} ChildLimits;

typedef enum {
    CHILD_DONE,
    CHILD_LATE,    // reached a time limit, its own or the parent's
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

// The following limits protect from hostile files. Only root can raise the resource limits again.

typedef struct {
    unsigned processor_seconds, seconds; // the second is wall time
} TimeLimits;

// For readers of files. confine_add_time adds processor time for larger files.
extern const TimeLimits reader_limits;

// Ends this process when the thread that started it ends, and at the time limits. From now on, the
// process gains no privileges, writes no file and dumps no core.
void confine_process(TimeLimits limits);

// Adds processor time for reading a file of this size, up to the limit of wall time.
void confine_add_time(uint64_t bytes);

// Limits a resource, such as RLIMIT_AS, to `most`, unless its hard limit is lower.
void confine_resource(int resource, rlim_t most);

// Returns the bytes mapped into this process so far, or 0 if the system does not report them.
rlim_t confine_mapped_memory(void);
