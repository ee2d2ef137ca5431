// SPDX-License-Identifier: MIT
// Allocates memory, and grows ARRAYs by doubling. Reports failures through Error.
#include "base/array.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

// Bytes. Devices that read host arrays in place load aligned vectors of up to 64 bytes.
#define ALIGNMENT ((size_t)64)

// Large arrays request huge pages. Rays read a tree's nodes in random order, so with small pages
// every second read misses the TLB. In a new array, the page faults of small pages would also take
// longer than filling the array.
#define HUGE_PAGE ((size_t)1 << 21)

static void *allocate(size_t bytes)
{
    const bool huge = bytes >= 2 * HUGE_PAGE;
    void *memory = NULL;
    if (posix_memalign(&memory, huge ? HUGE_PAGE : ALIGNMENT, bytes) != 0)
        return NULL;
    if (huge)
        madvise(memory, bytes, MADV_HUGEPAGE);
    return memory;
}

bool array_reserve(void **memory, size_t *capacity, size_t count, size_t size, Error *error)
{
    if (count <= *capacity)
        return true;
    const size_t least = *capacity < 8 ? 8 : *capacity;
    size_t wanted = *capacity == 0 && count > least
                        ? count
                        : least; // the first reservation is often the final size
    while (wanted < count && wanted <= SIZE_MAX / 2)
        wanted *= 2;
    if (wanted < count || wanted > SIZE_MAX / size)
        return error_out_of_memory(error, SIZE_MAX);
    void *grown = *memory == NULL ? allocate(wanted * size) : realloc(*memory, wanted * size);
    if (grown == NULL)
        return error_out_of_memory(error, wanted * size);
    *memory = grown;
    *capacity = wanted;
    return true;
}

static size_t byte_count(size_t count, size_t size)
{
    if (count == 0 || size == 0)
        return size > 0 ? size : 1;
    return count > SIZE_MAX / size ? SIZE_MAX : count * size;
}

void *memory_raw(size_t count, size_t size, Error *error)
{
    const size_t bytes = byte_count(count, size);
    void *memory = bytes > PTRDIFF_MAX ? NULL : allocate(bytes);
    if (memory == NULL)
        error_out_of_memory(error, bytes);
    return memory;
}

void *memory_sparse(size_t count, size_t size, Error *error)
{
    const size_t bytes = byte_count(count, size);
    void *memory = bytes > PTRDIFF_MAX ? NULL : malloc(bytes);
    if (memory == NULL)
        error_out_of_memory(error, bytes);
    return memory;
}

void *memory_zeroed(size_t count, size_t size, Error *error)
{
    void *memory = memory_raw(count, size, error);
    return memory != NULL ? memset(memory, 0, byte_count(count, size)) : NULL;
}
