// SPDX-License-Identifier: MIT
// Runs the tests that a program registers before main().
#include "unit/cmocka_all.h"

#define FIXTURES_MOST 2

static struct CMUnitTest tests[64];
static CMFixtureFunction set_ups[FIXTURES_MOST], tear_downs[FIXTURES_MOST];
static size_t test_count, set_up_count, tear_down_count;
static int tear_down_failures;

void test_set_up(CMFixtureFunction fixture)
{
    set_ups[set_up_count++] = fixture;
}

void test_tear_down(CMFixtureFunction fixture)
{
    tear_downs[tear_down_count++] = fixture;
}

void test_add(CMUnitTestFunction test, const char *name)
{
    tests[test_count++] = (struct CMUnitTest){.name = name, .test_func = test};
}

static int run_all(CMFixtureFunction *fixtures, size_t count, void **state)
{
    int failures = 0;
    for (size_t i = 0; i < count; i++)
        failures += fixtures[i](state) != 0;
    return failures;
}

static int set_up_all(void **state)
{
    return run_all(set_ups, set_up_count, state);
}

static int tear_down_all(void **state)
{
    return tear_down_failures = run_all(tear_downs, tear_down_count, state);
}

// The result is not the number of failures, because ctest reports tests with the exit status 77 as
// skipped. cmocka does not count failures of tear_down_all.
int tests_run(void)
{
    const int failures =
        _cmocka_run_group_tests("tests", tests, test_count, set_up_all, tear_down_all);
    return failures + tear_down_failures > 0;
}

// Programs with arguments have their own main().
__attribute__((weak)) int main(void)
{
    return tests_run();
}
