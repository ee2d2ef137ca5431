// SPDX-License-Identifier: MIT
// Counts the failing cases of the running test.
#include "outcome.h"

static size_t failing_cases;

void outcome_add(Outcome *sum, Outcome more)
{
    sum->test = more.test;
    sum->has_library = more.has_library;
    sum->has_peers = more.has_peers;
    sum->count += more.count;
    for (RayTracer tracer = 0; tracer < TRACERS; tracer++)
        sum->failures[tracer] += more.failures[tracer];
}

static const char *form_name(void)
{
    const char *name = getenv("CLRT_TEST_KERNEL");
    return name != NULL ? name : "packet";
}

void outcome_report(Outcome outcome, const char *details, ...)
{
    va_list arguments;
    const size_t *failures = outcome.failures;
    va_start(arguments, details);
    printf("%s form=%s ", outcome.test, form_name());
    vprintf(details, arguments);
    va_end(arguments);
    printf(" rays=%zu fail=%zu limit=%zu", outcome.count, failures[BY_CLRT], outcome.limit);
    if (outcome.has_library)
        printf(" library=%zu", failures[BY_LIBRARY]);
    if (outcome.has_peers)
        printf(" embree_default=%zu embree_robust=%zu", failures[BY_EMBREE_DEFAULT],
               failures[BY_EMBREE_ROBUST]);
    printf("\n");
    fflush(stdout);
    failing_cases += failures[BY_CLRT] > outcome.limit ||
                     (outcome.has_library && failures[BY_LIBRARY] != failures[BY_CLRT]);
}

void outcome_begin(void)
{
    failing_cases = 0;
}

void outcome_end(void)
{
    if (failing_cases > 0)
        fail_msg("%zu cases have more failures than their limits", failing_cases);
}
