// SPDX-License-Identifier: MIT
// How thorough a run of the tests is to be: tier 0 belongs to every change, tier 1 takes minutes,
// tier 2 is for releases.  CLRT_TEST_TIER in the environment says which, unset 0.
#pragma once

#include <stddef.h>
#include <stdlib.h>

static inline int tier(void)
{
    const char *text = getenv("CLRT_TEST_TIER");
    return text != NULL ? atoi(text) : 0;
}

// The size of something at tier 0, and at the others.
static inline size_t tier_size(size_t small, size_t full)
{
    return tier() == 0 ? small : full;
}
