// SPDX-License-Identifier: MIT
// Runs work on a thread with a larger stack if RLIMIT_STACK is small. RLIMIT_STACK bounds the main
// thread's stack and sets the default for other threads.
#include "cli/stack.h"

#include <pthread.h>
#include <stdbool.h>
#include <stddef.h>
#include <sys/resource.h>

#define STACK_LEAST ((rlim_t)8 << 20)
#define STACK_SIZE  ((size_t)16 << 20)

typedef struct {
    void (*work)(void *context);
    void *context;
} Task;

static void *run_task(void *context)
{
    const Task *task = context;
    task->work(task->context);
    return NULL;
}

static bool run_on_thread(Task *task)
{
    pthread_t thread;
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, STACK_SIZE);
    pthread_setattr_default_np(&attributes);
    const bool ok = pthread_create(&thread, &attributes, run_task, task) == 0;
    pthread_attr_destroy(&attributes);
    if (ok)
        pthread_join(thread, NULL);
    return ok;
}

void stack_run(void (*work)(void *context), void *context)
{
    struct rlimit limit;
    Task task = {work, context};
    const bool is_small = getrlimit(RLIMIT_STACK, &limit) == 0 && limit.rlim_cur < STACK_LEAST;
    if (!is_small || !run_on_thread(&task))
        work(context);
}
