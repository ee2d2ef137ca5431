// SPDX-License-Identifier: MIT
// Prints one line for each case of a test. gather.py makes a table of these lines: T-03 form=packet
// k=10 aim=vertices rays=10000 fail=0 limit=0 embree_default=3451 ...
#pragma once

#include "check.h"

// The ray tracers of a case.
typedef enum { BY_CLRT, BY_LIBRARY, BY_EMBREE_DEFAULT, BY_EMBREE_ROBUST, TRACERS } RayTracer;

typedef struct {
    const char *test;
    size_t count;             // rays, pixels or boxes
    size_t failures[TRACERS]; // wrong rays, pixels or boxes, by ray tracer
    size_t limit;             // the largest number of clrt's failures with which the case passes
    bool has_library;         // libclrt has traced the rays; it must have as many failures as clrt
    bool has_peers;           // Embree has traced the rays
} Outcome;

// Returns the outcome of a case that only clrt traces and whose limit is 0.
static inline Outcome outcome_of(const char *test, size_t count, size_t failures)
{
    return (Outcome){.test = test, .count = count, .failures = {failures}};
}

// Adds the count and failures of another case of the same test. sum must be {0} before the first
// case.
void outcome_add(Outcome *sum, Outcome more);

// Prints the outcome. details is a format that describes the case.
__attribute__((format(printf, 2, 3))) void outcome_report(Outcome outcome, const char *details,
                                                          ...);

// Registers the fixtures of all tests of a program. set_up sets the tests' *state.
#define FIXTURES(set_up, tear_down)                                                                \
    AT_START(fixtures)                                                                             \
    {                                                                                              \
        test_set_up(set_up);                                                                       \
        test_tear_down(tear_down);                                                                 \
    }

// A TEST that runs all its cases, and fails at the end if a case had more failures than its limit.
#define EXTREME(name)                                                                              \
    static void name##_cases(void **);                                                             \
    TEST(name)                                                                                     \
    {                                                                                              \
        outcome_begin();                                                                           \
        name##_cases(state);                                                                       \
        outcome_end();                                                                             \
    }                                                                                              \
    static void name##_cases(__attribute__((unused)) void **state)
void outcome_begin(void);
void outcome_end(void);
