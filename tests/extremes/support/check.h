// SPDX-License-Identifier: MIT
// Shared by all tests of the extremes: cmocka, and failing with an Error's reason.
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
