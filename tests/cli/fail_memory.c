// SPDX-License-Identifier: MIT
// If preloaded, this library makes clrt run out of memory: calls of malloc, realloc and
// posix_memalign fail from number CLRT_FAIL_MEMORY on. calloc, strdup and all calls by libraries
// succeed.
#include <dlfcn.h>
#include <errno.h>
#include <link.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>

// The range of the program's code. The program is the first object that the loader reports.
static uintptr_t program_start, program_end;
static long first_failure;
static atomic_long allocations;

static int find_program(struct dl_phdr_info *object, size_t size, void *unused)
{
    (void)size;
    (void)unused;
    for (int i = 0; i < object->dlpi_phnum; i++) {
        const ElfW(Phdr) *segment = &object->dlpi_phdr[i];
        if (segment->p_type == PT_LOAD && (segment->p_flags & PF_X) != 0) {
            program_start = object->dlpi_addr + segment->p_vaddr;
            program_end = program_start + segment->p_memsz;
        }
    }
    return 1;
}

__attribute__((constructor)) static void begin(void)
{
    const char *text = getenv("CLRT_FAIL_MEMORY");
    dl_iterate_phdr(find_program, NULL);
    first_failure = text == NULL ? 0 : atol(text);
}

static bool fails(const void *caller)
{
    const uintptr_t place = (uintptr_t)caller;
    return first_failure > 0 && place >= program_start && place < program_end &&
           atomic_fetch_add(&allocations, 1) + 1 >= first_failure;
}

static void *real(const char *name)
{
    void *function = dlsym(RTLD_NEXT, name);
    if (function == NULL)
        abort();
    return function;
}

void *malloc(size_t size)
{
    static void *(*next)(size_t);
    if (next == NULL)
        *(void **)&next = real("malloc");
    return fails(__builtin_return_address(0)) ? NULL : next(size);
}

void *realloc(void *memory, size_t size)
{
    static void *(*next)(void *, size_t);
    if (next == NULL)
        *(void **)&next = real("realloc");
    return fails(__builtin_return_address(0)) ? NULL : next(memory, size);
}

int posix_memalign(void **memory, size_t alignment, size_t size)
{
    static int (*next)(void **, size_t, size_t);
    if (next == NULL)
        *(void **)&next = real("posix_memalign");
    return fails(__builtin_return_address(0)) ? ENOMEM : next(memory, alignment, size);
}
