// SPDX-License-Identifier: MIT
// PoCL 3.1 and 6.0 read different variables, so clrt sets both.
#include "device/threads.h"

#include "base/processors.h"

#include <stdio.h>
#include <stdlib.h>

uint32_t threads_allowed(uint32_t count)
{
    return count > 0 ? count : processors_usable();
}

void threads_limit(uint32_t count)
{
    char text[16];
    const uint32_t usable = processors_usable();
    if (count == 0 && usable >= processors_present())
        return;
    snprintf(text, sizeof text, "%u", count > 0 ? count : usable);
    setenv("POCL_MAX_PTHREAD_COUNT", text, count > 0);
    setenv("POCL_CPU_MAX_CU_COUNT", text, count > 0);
}
