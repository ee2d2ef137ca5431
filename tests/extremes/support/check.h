// SPDX-License-Identifier: MIT
// All tests of the extremes share these helpers: cmocka, requirements, and the size of a run.
#pragma once

#include "base/array.h"
#include "unit/cmocka_all.h"

#include <stdio.h>
#include <stdlib.h>

#define COUNT(array) (sizeof(array) / sizeof *(array))

// Ends the test with the error's text unless ok.
static inline void require(bool ok, const Error *error)
{
    if (!ok)
        fail_msg("%s", error->text);
}

// Returns uninitialized memory for count elements of size bytes. The caller frees it.
static inline void *require_memory(size_t count, size_t size)
{
    Error error = {0};
    void *memory = memory_raw(count, size, &error);
    require(memory != NULL, &error);
    return memory;
}

// Returns the tier in CLRT_TEST_TIER: 0 (the default) for every change, 1 for runs of minutes,
// 2 for releases.
static inline int tier(void)
{
    const char *text = getenv("CLRT_TEST_TIER");
    return text != NULL ? atoi(text) : 0;
}

// Returns `small` at tier 0 and `full` at the other tiers.
static inline size_t tier_size(size_t small, size_t full)
{
    return tier() == 0 ? small : full;
}
