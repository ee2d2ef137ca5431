// SPDX-License-Identifier: MIT
// Limits a process that reads possibly hostile files, for the rest of its life. Nothing that it
// reads later can lift the limits.
#pragma once

#include <sys/resource.h>

// Ends the process with the thread that started it, and after this many seconds of processor or
// wall time. It then gains no privileges, writes no file and dumps no core.
void confine_process(unsigned seconds);

// Limits a resource, such as RLIMIT_AS, to `most`, unless the system's limit is lower.
void confine_resource(int resource, rlim_t most);

// Returns the bytes mapped into the process so far, 0 if the system does not report them.
rlim_t confine_mapped_memory(void);
