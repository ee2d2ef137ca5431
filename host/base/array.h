// SPDX-License-Identifier: MIT
// Growable arrays of any type. `ARRAY(Light) lights = {0};` declares one, and array_push appends to
// it. The anonymous union lets one function grow all arrays without violating C's aliasing rules.
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

// Reserves memory for `count` elements of `size` bytes each. Returns false if memory runs out, and
// then leaves the array unchanged.
bool array_reserve(void **memory, size_t *capacity, size_t count, size_t size, Error *error);

// Appends `item`. Evaluates to false if memory runs out.
#define array_push(array, item, error)                                                             \
    (array_reserve(&(array)->memory, &(array)->capacity, (array)->count + 1,                       \
                   sizeof *(array)->data, error) &&                                                \
     ((array)->data[(array)->count++] = (item), true))

// Both functions allocate `count` elements of `size` bytes, aligned to 64 bytes. They return NULL
// and fill Error if memory runs out. The caller frees the result, even if `count` is 0.
void *memory_zeroed(size_t count, size_t size, Error *error);
void *memory_raw(size_t count, size_t size, Error *error);

// Like memory_raw, but elements take no physical memory until they are written. The array gets no
// huge pages and is not aligned to 64 bytes.
void *memory_sparse(size_t count, size_t size, Error *error);
