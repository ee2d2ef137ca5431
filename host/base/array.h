// SPDX-License-Identifier: MIT
// Growable arrays of any element type: ARRAY(Light) lights = {0}; array_push(&lights, light,
// error). The anonymous union lets one growth function serve every type without breaking aliasing
// rules.
#pragma once

#include "base/error.h"

#include <stddef.h>

#define ARRAY(type)                                                                                \
    struct {                                                                                       \
        union {                                                                                    \
            type *data;                                                                            \
            void *memory;                                                                          \
        };                                                                                         \
        size_t count, capacity;                                                                    \
    }

// Makes room for count elements of size bytes.  False leaves the array as it was.
bool array_reserve(void **memory, size_t *capacity, size_t count, size_t size, Error *error);

// Appends item; an expression, false when memory ran out.
#define array_push(array, item, error)                                                             \
    (array_reserve(&(array)->memory, &(array)->capacity, (array)->count + 1,                       \
                   sizeof *(array)->data, error) &&                                                \
     ((array)->data[(array)->count++] = (item), true))

// calloc and malloc of count elements, aligned to 64 bytes, that fill Error instead of returning
// NULL silently; NULL on overflow or exhaustion.  Zero elements give a pointer that may be freed.
void *memory_zeroed(size_t count, size_t size, Error *error);
void *memory_raw(size_t count, size_t size, Error *error);

// memory_raw for an array most of which is never touched: pages no larger than need be.
void *memory_sparse(size_t count, size_t size, Error *error);
