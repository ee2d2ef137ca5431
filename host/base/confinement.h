// SPDX-License-Identifier: MIT
// What a process gives up that reads files which may be hostile, for the whole of its life: nothing
// that it reads later can bring it back.
#pragma once

#include <sys/resource.h>

// Ends the process with the thread that started it and after so many seconds, of the processor and
// of the clock; it gains no privileges, writes no file and leaves no core.
void confine_process(unsigned seconds);

// Allows so much of a resource, such as RLIMIT_AS, or less where the system already did.
void confine_resource(int resource, rlim_t most);

// The bytes that are mapped into the process by now, 0 where the system does not tell.
rlim_t confine_mapped_memory(void);
