// SPDX-License-Identifier: MIT
// Tests the limits of clrt-foreign, and that it ends with its parent.
#include "foreign/process_limits.h"

#include "unit/cmocka_all.h"

#include <errno.h>
#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

// Calls `work` in a child process. `work` writes a report to `end`. Returns the child's status
// after the child and its own children have ended.
static int status_of(void (*work)(int end), void *report, size_t size)
{
    int ends[2], status;
    assert_int_equal(pipe2(ends, 0), 0);
    const pid_t id = fork();
    if (id == 0) {
        dup2(ends[1], STDOUT_FILENO); // process_limits_take closes other files
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
    process_limits_take();
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
    process_limits_take();
    process_limits_take_model();
    for (int i = 0; i < 3; i++) {
        process_limits_allow_file(sizes[i]);
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
    process_limits_take();
    process_limits_take_model();
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

// Lowers the limit to an eighth, so that the test takes a second.
static void burn(int end)
{
    struct rlimit limit;
    process_limits_take();
    getrlimit(RLIMIT_CPU, &limit);
    limit.rlim_cur /= 8;
    setrlimit(RLIMIT_CPU, &limit);
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
