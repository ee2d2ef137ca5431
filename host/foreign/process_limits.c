// SPDX-License-Identifier: MIT
// Limits this process by setrlimit, and by an alarm for elapsed time.
//
// The memory for models has a soft limit. Each file that is read raises this limit, up to a hard
// limit. In some formats, nodes can share children, so a short file can describe a vast model. The
// soft limit stops such files early.
#include "foreign/process_limits.h"

#include "base/processors.h"
#include "image/stored_image.h"

#include <malloc.h>
#include <signal.h>
#include <stdio.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#define MEMORY_MOST       ((rlim_t)12 << 30)  // bytes beyond the memory already mapped
#define MEMORY_LEAST      ((rlim_t)256 << 20) // bytes that even the shortest file may use
#define MEMORY_FACTOR     128                 // bytes of memory per byte of a file
#define MEMORY_PER_THREAD ((rlim_t)16 << 20)  // bytes; mostly stack
#define STACK_LIMIT       ((rlim_t)8 << 20)   // bytes; very deep trees of nodes crash this process
#define FILE_LIMIT        32                  // open files
#define PROCESSOR_SECONDS 8                   // of processor time for the shortest file
#define SECONDS           120                 // of elapsed time
#define BYTES_PER_SECOND  2000000 // each file adds a second of processor time per this many bytes

// AddressSanitizer maps more memory than any limit could allow, so builds with it do not limit
// memory. gcc defines a macro for AddressSanitizer, and clang has __has_feature.
#ifndef __has_feature
#define __has_feature(name) 0
#endif
#if defined(__SANITIZE_ADDRESS__) || __has_feature(address_sanitizer)
#define LIMITS_MEMORY false
#else
#define LIMITS_MEMORY true
#endif

// Sets a limit. Ignores failures, because the call fails only if the hard limit is already lower.
static void limit(__rlimit_resource_t resource, rlim_t soft, rlim_t hard)
{
    const struct rlimit both = {soft, hard};
    if (resource != RLIMIT_AS || LIMITS_MEMORY)
        setrlimit(resource, &both);
}

// Raises the soft limit by `more`, but keeps it below the hard limit.
static void raise_limit(__rlimit_resource_t resource, uint64_t more)
{
    struct rlimit now;
    if (getrlimit(resource, &now) != 0 || now.rlim_cur >= now.rlim_max)
        return;
    const rlim_t left = now.rlim_max - 1 - now.rlim_cur;
    limit(resource, now.rlim_cur + (more < left ? more : left), now.rlim_max);
}

void process_limits_take(void)
{
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
    close_range(STDERR_FILENO + 1, ~0U, 0);
    // The system sends SIGXCPU at the soft limit, and SIGKILL at the hard limit.
    limit(RLIMIT_CPU, PROCESSOR_SECONDS, SECONDS + 1);
    limit(RLIMIT_FSIZE, 0, 0);
    limit(RLIMIT_CORE, 0, 0);
    limit(RLIMIT_NOFILE, FILE_LIMIT, FILE_LIMIT);
    limit(RLIMIT_STACK, STACK_LIMIT, STACK_LIMIT);
    alarm(SECONDS);
}

// Returns the number of bytes mapped into this process so far, or 0 if it is unknown.
static rlim_t mapped_memory(void)
{
    unsigned long pages = 0;
    FILE *stream = fopen("/proc/self/statm", "r");
    if (stream == NULL || fscanf(stream, "%lu", &pages) != 1)
        pages = 0;
    if (stream != NULL)
        fclose(stream);
    return (rlim_t)pages * (rlim_t)sysconf(_SC_PAGESIZE);
}

static rlim_t smaller(rlim_t a, rlim_t b)
{
    return a < b ? a : b;
}

// Allows at most 3/4 of the machine's memory in addition to the memory that is already mapped,
// because other processes need memory too.
void process_limits_take_model(void)
{
    const rlim_t machine = (rlim_t)sysconf(_SC_PHYS_PAGES) * (rlim_t)sysconf(_SC_PAGESIZE);
    const rlim_t most = smaller(machine / 4 * 3, MEMORY_MOST), mapped = mapped_memory();
    limit(RLIMIT_NPROC, 0, 0);
    limit(RLIMIT_AS, mapped + smaller(MEMORY_LEAST, most), mapped + most);
}

void process_limits_allow_file(uint64_t bytes)
{
    raise_limit(RLIMIT_CPU, bytes / BYTES_PER_SECOND);
    raise_limit(RLIMIT_AS, bytes < MEMORY_MOST ? bytes * MEMORY_FACTOR : MEMORY_MOST);
}

// Allows memory for the most values that clrt accepts from the file, as much again for the decoder,
// MEMORY_PER_THREAD for each thread, and MEMORY_LEAST.
void process_limits_take_picture(uint64_t bytes)
{
    const rlim_t most = mapped_memory() + 2 * sizeof(float) * stored_values_most(bytes) +
                        processors_present() * MEMORY_PER_THREAD + MEMORY_LEAST;
    mallopt(M_ARENA_MAX, 1);
    raise_limit(RLIMIT_CPU, bytes / BYTES_PER_SECOND);
    limit(RLIMIT_AS, most, most);
}
