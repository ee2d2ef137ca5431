// SPDX-License-Identifier: MIT
// Tests thread pools with fewer tasks than threads. The tasks are short, so workers often wake too
// late for them.
#include "base/thread_pool.h"
#include "unit/cmocka_all.h"

#include <sched.h>
#include <stdatomic.h>

#define THREADS     8
#define GENERATIONS 5000
#define TASKS_MOST  5

// The tasks that have run. Each generation has a context of its own.
typedef struct {
    atomic_uint runs[TASKS_MOST];
} Runs;

static void count_run(void *context, uint32_t task)
{
    Runs *runs = context;
    sched_yield(); // so that other threads take tasks too
    atomic_fetch_add(&runs->runs[task], 1);
}

static void expect_one_run_each(ThreadPool *pool, uint32_t tasks)
{
    Runs runs = {0};
    thread_pool_run(pool, tasks, count_run, &runs);
    for (uint32_t task = 0; task < TASKS_MOST; task++)
        assert_int_equal(atomic_load(&runs.runs[task]), task < tasks);
}

TEST(each_task_of_many_short_generations_runs_once_before_the_call_returns)
{
    ThreadPool *pool = thread_pool_open(THREADS);
    for (uint32_t i = 0; i < GENERATIONS; i++)
        expect_one_run_each(pool, i % (TASKS_MOST + 1));
    thread_pool_close(pool);
}
