// SPDX-License-Identifier: MIT
#include "cli/stack.h"

#include <pthread.h>
#include <stdbool.h>
#include <stddef.h>
#include <sys/resource.h>

// RLIMIT_STACK limits the main thread's stack and is the default size of other threads' stacks.
#define STACK_LEAST ((rlim_t)8 << 20)
#define STACK_SIZE  ((size_t)16 << 20)

static bool run_on_thread(void *(*work)(void *context), void *context)
{
    pthread_t thread;
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, STACK_SIZE);
    pthread_setattr_default_np(&attributes);
    const bool ok = pthread_create(&thread, &attributes, work, context) == 0;
    pthread_attr_destroy(&attributes);
    if (ok)
        pthread_join(thread, NULL);
    return ok;
}

void stack_run(void *(*work)(void *context), void *context)
{
    struct rlimit limit;
    const bool is_small = getrlimit(RLIMIT_STACK, &limit) == 0 && limit.rlim_cur < STACK_LEAST;
    if (!is_small || !run_on_thread(work, context))
        work(context);
}
