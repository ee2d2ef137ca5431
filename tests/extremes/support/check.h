// SPDX-License-Identifier: MIT
// What all tests of the extremes share: cmocka, failing with the reason of a world fault, and one
// machine-readable line for each case.
#pragma once

#include "base/error.h"

// clang-format off
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <cmocka.h>
// clang-format on

// Ends the test where something that is not under test went wrong.
static inline void require(bool ok, const Error *error)
{
    if (!ok)
        fail_msg("%s", error->text);
}

// Prints "T-03 k=10 rays=100000 fail=0 limit=0" and returns fail, for the test to add up: all its
// cases are to be seen, not only those before the first failure.  rays counts whatever the case
// judges: rays, pixels or boxes.
static inline size_t report_case(const char *test, const char *details, size_t rays, size_t fail)
{
    printf("%s %s rays=%zu fail=%zu limit=0\n", test, details, rays, fail);
    fflush(stdout);
    return fail;
}
