// SPDX-License-Identifier: MIT
// Calls that must fail, and say why.
#pragma once

#include <clrt.h>

// An error that is filled with other bytes, so that what is left of them would show.
ClrtError faults_blank(void);

// Fails the test unless ok is false and error has that fault and a message that contains words.
void faults_assert(bool ok, const ClrtError *error, ClrtFault fault, const char *words);

// The call, which fills `error`, must find an argument that it cannot work with.
#define ASSERT_ARGUMENT(call, words)                                                               \
    do {                                                                                           \
        ClrtError error = faults_blank();                                                          \
        const bool done = (call);                                                                  \
        faults_assert(done, &error, CLRT_ARGUMENT, words);                                         \
    } while (0)
