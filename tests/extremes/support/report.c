// SPDX-License-Identifier: MIT
// The form of the kernels is that of all cases of a process.
#include "report.h"

#include <stdio.h>
#include <stdlib.h>

static const char *form_name(void)
{
    const char *name = getenv("CLRT_TEST_KERNEL");
    return name != NULL ? name : "packet";
}

size_t report(const Case *made)
{
    printf("%s form=%s %s rays=%zu fail=%zu limit=%zu", made->test, form_name(), made->details,
           made->rays, made->fail, made->limit);
    if (made->peers.known)
        printf(" embree_default=%zu embree_robust=%zu", made->peers.plain, made->peers.robust);
    printf("\n");
    fflush(stdout);
    return made->fail > made->limit ? made->fail - made->limit : 0;
}

size_t report_case(const char *test, const char *details, size_t rays, size_t fail)
{
    return report(&(Case){.test = test, .details = details, .rays = rays, .fail = fail});
}

void report_passed_over(const char *test, const char *reason)
{
    printf("%s form=%s skipped: %s\n", test, form_name(), reason);
    fflush(stdout);
}
