// SPDX-License-Identifier: MIT
// The soft memory limit rises with each file read, up to a hard limit. With the hard limit alone, a
// short file whose nodes share children could use that much memory.
#include "foreign/model.h"

#include "base/child_process.h"

#include <unistd.h>

#define MEMORY_MOST   ((rlim_t)12 << 30)  // bytes beyond the memory already mapped
#define MEMORY_LEAST  ((rlim_t)256 << 20) // bytes that even the shortest file may use
#define MEMORY_FACTOR 128                 // bytes of memory per byte of a file
#define STACK_LIMIT   ((rlim_t)8 << 20)   // bytes; too deep a tree of nodes crashes this process
#define FILE_LIMIT    32                  // open files

// AddressSanitizer maps more memory than any limit could allow. gcc defines a macro for it; clang
// has __has_feature.
#ifndef __has_feature
#define __has_feature(name) 0
#endif
#if defined(__SANITIZE_ADDRESS__) || __has_feature(address_sanitizer)
static void limit_memory(void)
{
}

void limits_allow_file(size_t bytes)
{
    (void)bytes;
}
#else
static rlim_t smaller(rlim_t a, rlim_t b)
{
    return a < b ? a : b;
}

// Limits memory to at most 3/4 of the machine's, because other processes need some.
static void limit_memory(void)
{
    const rlim_t machine = (rlim_t)sysconf(_SC_PHYS_PAGES) * (rlim_t)sysconf(_SC_PAGESIZE);
    const rlim_t most = smaller(machine / 4 * 3, MEMORY_MOST), mapped = confine_mapped_memory();
    const struct rlimit now = {mapped + smaller(MEMORY_LEAST, most), mapped + most};
    setrlimit(RLIMIT_AS, &now);
}

void limits_allow_file(size_t bytes)
{
    struct rlimit now;
    if (getrlimit(RLIMIT_AS, &now) != 0)
        return;
    const rlim_t left = now.rlim_max - now.rlim_cur;
    now.rlim_cur += bytes < left / MEMORY_FACTOR ? bytes * MEMORY_FACTOR : left;
    setrlimit(RLIMIT_AS, &now);
}
#endif

void limits_take(void)
{
    close_range(STDERR_FILENO + 1, ~0U, 0);
    confine_process(reader_limits);
    confine_resource(RLIMIT_NPROC, 0);
    confine_resource(RLIMIT_NOFILE, FILE_LIMIT);
    confine_resource(RLIMIT_STACK, STACK_LIMIT);
    limit_memory();
}
