// SPDX-License-Identifier: MIT
// Includes cmocka.h and the headers that it requires. Tests register themselves. A program that
// defines its tests by TEST() gets its main() from unit/tests.c, or calls tests_run().
#pragma once

// clang-format off
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
// clang-format on

// Register a function that runs before all tests, a function that runs after all tests, and a test.
// Tests run in the order of the file.
void test_set_up(CMFixtureFunction fixture);
void test_tear_down(CMFixtureFunction fixture);
void test_add(CMUnitTestFunction test, const char *name);

// Runs the registered tests. Returns 0 if all succeed, otherwise 1.
int tests_run(void);

#define AT_START(name) __attribute__((constructor)) static void at_start_##name(void)

#define TEST(name)                                                                                 \
    static void name(void **);                                                                     \
    AT_START(name)                                                                                 \
    {                                                                                              \
        test_add(name, #name);                                                                     \
    }                                                                                              \
    static void name(__attribute__((unused)) void **state)

// The bodies of SET_UP(name) and TEAR_DOWN(name) return 0. Other values make the program fail.
#define FIXTURE(name, add)                                                                         \
    static int name(void **);                                                                      \
    AT_START(name)                                                                                 \
    {                                                                                              \
        add(name);                                                                                 \
    }                                                                                              \
    static int name(__attribute__((unused)) void **state)
#define SET_UP(name)    FIXTURE(name, test_set_up)
#define TEAR_DOWN(name) FIXTURE(name, test_tear_down)

// Calls `function` to free a local variable at the end of its block.
#define FREED_BY(function) __attribute__((cleanup(function), unused))
