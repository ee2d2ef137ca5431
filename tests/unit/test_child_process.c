// SPDX-License-Identifier: MIT
// Tests a child process's streams, environment and limits, and that the child ends with its parent.
#include "base/child_process.h"

#include "foreign/process_limits.h"
#include "unit/cmocka_all.h"

#include <errno.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

static ChildFate collect(const char *script, File *output, int *signal)
{
    const char *const words[] = {"/bin/sh", "-c", script, NULL};
    const ChildLimits limits = {.seconds = 60, .bytes = 20000000};
    ChildProcess child;
    Error error = {0};
    assert_true(child_spawn(&child, words, &error));
    return child_collect(&child, &limits, output, signal, &error);
}

TEST(a_long_output_arrives_whole)
{
    FREED_BY(file_free) File output;
    int signal;
    collect("yes | head -c 10000000", &output, &signal);
    assert_int_equal(output.size, 10000000);
    for (size_t i = 0; i < output.size; i += 2)
        assert_memory_equal(output.bytes + i, "y\n", 2);
}

TEST(a_child_has_empty_streams)
{
    FREED_BY(file_free) File output;
    int signal;
    collect("wc -c; test -t 1 || echo none; echo lost >&2", &output, &signal);
    assert_int_equal(output.size, strlen("0\nnone\n"));
}

TEST(ending_no_child_is_harmless)
{
    ChildProcess none = {0};
    assert_int_equal(child_end(&none), 0);
}

// Calls `work` in a child process. `work` writes a report to `end`. Returns the child's status
// after the child and its own children have ended.
static int status_of(void (*work)(int end), void *report, size_t size)
{
    int ends[2], status;
    assert_int_equal(pipe2(ends, 0), 0);
    const pid_t id = fork();
    if (id == 0) {
        dup2(ends[1], STDOUT_FILENO); // limits_take closes other files
        work(STDOUT_FILENO);
        _exit(0);
    }
    close(ends[1]);
    assert_int_equal(read(ends[0], report, size), size);
    assert_int_equal(read(ends[0], report, 1), 0);
    close(ends[0]);
    assert_int_equal(waitpid(id, &status, 0), id);
    return status;
}

static void leave_a_child(int end)
{
    const pid_t parent = getpid();
    if (fork() != 0)
        for (;;)
            pause();
    limits_take();
    if (write(end, "", 1) == 1)
        kill(parent, SIGKILL);
    sleep(60);
}

TEST(a_limited_child_ends_with_its_parent)
{
    char started;
    const double start = (double)time(NULL);
    const int status = status_of(leave_a_child, &started, 1);
    assert_true(WIFSIGNALED(status) && (double)time(NULL) - start < 20);
}

// Reports the limit of processor time without a file, after a file of 10 MB, and after another file
// of 1 TB. Then reports the limit of elapsed time.
static void report_limits(int end)
{
    static const uint64_t sizes[3] = {0, 10000000, 1000000000000};
    unsigned seconds[4];
    struct rlimit limit;
    limits_take();
    limits_take_model();
    for (int i = 0; i < 3; i++) {
        limits_allow_file(sizes[i]);
        getrlimit(RLIMIT_CPU, &limit);
        seconds[i] = (unsigned)limit.rlim_cur;
    }
    seconds[3] = alarm(0);
    if (write(end, seconds, sizeof seconds) != sizeof seconds)
        abort();
}

TEST(processor_time_grows_with_the_files_read_up_to_a_limit)
{
    unsigned seconds[4];
    status_of(report_limits, seconds, sizeof seconds);
    assert_int_equal(seconds[0], 8);
    assert_int_equal(seconds[1], 13);
    assert_int_equal(seconds[2], 120);
    assert_in_range(seconds[3], 100, 120);
}

static void *do_nothing(void *context)
{
    return context;
}

// Reports the error of starting a thread. Limits of processes do not bind root.
static void start_thread(int end)
{
    pthread_t thread;
    limits_take();
    limits_take_model();
    const int user = geteuid() == 0 ? setuid(65534) : 0;
    const int fault = user == 0 ? pthread_create(&thread, NULL, do_nothing, NULL) : EAGAIN;
    if (write(end, &fault, sizeof fault) != sizeof fault)
        abort();
}

TEST(a_child_that_reads_a_model_starts_no_threads)
{
    int fault;
    status_of(start_thread, &fault, sizeof fault);
    assert_int_equal(fault, EAGAIN);
}

static void burn(int end)
{
    limits_take();
    if (write(end, "", 1) == 1)
        for (;;)
            getppid();
}

// On a loaded machine, the limit of elapsed time may end the child first.
TEST(a_limited_child_ends_after_its_processor_time)
{
    char started;
    const int status = status_of(burn, &started, 1);
    assert_true(WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGALRM);
}

static atomic_bool has_spawned;

// Adds and removes variables, so that the C library moves environ repeatedly.
static void *add_variables(void *context)
{
    (void)context;
    for (int round = 0; !has_spawned; round++) {
        char name[32];
        snprintf(name, sizeof name, "CLRT_TEST_%d", round % 5000);
        round % 10000 < 5000 ? setenv(name, "1", 1) : unsetenv(name);
    }
    return NULL;
}

TEST(children_start_while_another_thread_changes_the_environment)
{
    pthread_t thread;
    pthread_create(&thread, NULL, add_variables, NULL);
    for (int i = 0; i < 300; i++) {
        ChildProcess child;
        Error error = {0};
        const bool is_spawned = child_spawn(&child, (const char *[]){"/bin/true", NULL}, &error);
        assert_string_equal(error.text, "");
        assert_true(is_spawned);
        child_end(&child);
    }
    has_spawned = true;
    pthread_join(thread, NULL);
}

TEST(a_spawned_child_has_the_environment_of_the_start)
{
    ChildProcess child;
    FREED_BY(file_free) File output;
    Error error = {0};
    int signal;
    const ChildLimits limits = {.seconds = 60, .bytes = 1000000};
    setenv("CLRT_TEST_LATE", "1", 1);
    assert_true(child_spawn(&child, (const char *[]){"/usr/bin/env", "-0", NULL}, &error));
    // env closes its output before it ends, so child_collect may kill it in between.
    const ChildFate fate = child_collect(&child, &limits, &output, &signal, &error);
    assert_true(fate == CHILD_DONE || signal == SIGKILL);
    assert_null(memmem(output.bytes, output.size, "CLRT_TEST_LATE", strlen("CLRT_TEST_LATE")));
    const char *path = getenv("PATH");
    assert_non_null(memmem(output.bytes, output.size, path, strlen(path) + 1));
}
