// SPDX-License-Identifier: MIT
// What all tests of the extremes share: cmocka, and failing with the reason of a world fault.
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
