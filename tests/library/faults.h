// SPDX-License-Identifier: MIT
// Checks calls that must fail with a message.
#pragma once

#include "unit/cmocka_all.h"

#include <clrt.h>
#include <string.h>

// Returns an error filled with arbitrary bytes, so that tests notice bytes that a call does not
// set.
static inline ClrtError faults_blank(void)
{
    ClrtError error;
    memset(&error, 0x55, sizeof error);
    return error;
}

// Fails the test unless ok is false and error has the fault and a message that contains `words`.
static inline void faults_assert(bool ok, const ClrtError *error, ClrtFault fault,
                                 const char *words)
{
    assert_false(ok);
    assert_int_equal(error->fault, fault);
    assert_non_null(memchr(error->text, '\0', sizeof error->text));
    if (strstr(error->text, words) == NULL)
        fail_msg("'%s' does not say '%s'", error->text, words);
}

// Fails the test unless the call, which fills `error`, reports an invalid argument.
#define REFUSES(call, words)                                                                       \
    do {                                                                                           \
        ClrtError error = faults_blank();                                                          \
        const bool done = (call);                                                                  \
        faults_assert(done, &error, CLRT_ARGUMENT, words);                                         \
    } while (0)
