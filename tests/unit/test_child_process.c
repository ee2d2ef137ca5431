// SPDX-License-Identifier: MIT
// Tests that a child process answers and has no terminal, that its end does not end other
// processes, and that it ends with its parent.
#include "base/child_process.h"

#include "unit/cmocka_all.h"

#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

static void start(ChildProcess *child, ChildWork *work, const void *context)
{
    Error error = {0};
    assert_true(child_fork(child, work, context, &error));
}

static void double_numbers(int socket, const void *context)
{
    int number;
    (void)context;
    while (child_receive(socket, &number, sizeof number)) {
        number *= 2;
        child_send(socket, &number, sizeof number);
    }
}

TEST(a_child_answers_until_it_is_ended)
{
    ChildProcess child;
    start(&child, double_numbers, NULL);
    for (int number = 1; number < 1000; number++) {
        int answer = 0;
        assert_true(child_send(child.socket, &number, sizeof number));
        assert_true(child_receive(child.socket, &answer, sizeof answer));
        assert_int_equal(answer, 2 * number);
    }
    const int status = child_end(&child);
    assert_true(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
}

static void send_much(int socket, const void *context)
{
    static char bytes[10000000];
    memset(bytes, 7, sizeof bytes);
    (void)context;
    child_send(socket, bytes, sizeof bytes);
}

static void take_signal(int number)
{
    (void)number;
}

static void send_among_signals(int socket, const void *context)
{
    const struct sigaction action = {.sa_handler = take_signal};
    const struct itimerval often = {{0, 1000}, {0, 1000}};
    sigaction(SIGALRM, &action, NULL);
    setitimer(ITIMER_REAL, &often, NULL);
    send_much(socket, context);
}

// While the parent sleeps, the child waits for room in the socket's buffer, and signals arrive.
TEST(signals_do_not_cut_a_message)
{
    static char bytes[10000000];
    ChildProcess child;
    start(&child, send_among_signals, NULL);
    usleep(50000);
    assert_true(child_receive(child.socket, bytes, sizeof bytes));
    assert_int_equal(bytes[sizeof bytes - 1], 7);
    child_end(&child);
}

TEST(a_long_message_arrives_whole)
{
    static char bytes[10000000];
    ChildProcess child;
    start(&child, send_much, NULL);
    assert_true(child_receive(child.socket, bytes, sizeof bytes));
    for (size_t i = 0; i < sizeof bytes; i++)
        assert_int_equal(bytes[i], 7);
    assert_false(child_receive(child.socket, bytes, 1));
    child_end(&child);
}

static void report_streams(int socket, const void *context)
{
    char letter;
    (void)context;
    const int empty = read(STDIN_FILENO, &letter, 1) == 0 && !isatty(STDOUT_FILENO);
    child_send(socket, &empty, sizeof empty);
}

TEST(a_child_has_empty_streams)
{
    ChildProcess child;
    int empty = 0;
    start(&child, report_streams, NULL);
    assert_true(child_receive(child.socket, &empty, sizeof empty));
    child_end(&child);
    assert_true(empty);
}

static void die(int socket, const void *context)
{
    (void)socket, (void)context;
    raise(SIGKILL);
}

// Sending must not raise SIGPIPE, which would end this process.
TEST(messages_to_a_dead_child_fail)
{
    ChildProcess child;
    char bytes[100] = "";
    start(&child, die, NULL);
    assert_false(child_receive(child.socket, bytes, sizeof bytes));
    assert_false(child_send(child.socket, bytes, sizeof bytes));
    child_end(&child);
}

TEST(ending_no_child_is_harmless)
{
    ChildProcess none = {0};
    assert_int_equal(child_end(&none), 0);
}

static void sleep_long(int socket, const void *context)
{
    (void)context;
    child_send(socket, "", 1);
    sleep(60);
}

// The pipe's writing end stays open until the forked process and its child have ended.
TEST(a_child_ends_with_its_parent)
{
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    const pid_t parent = fork();
    if (parent == 0) {
        ChildProcess child;
        Error error = {0};
        char started;
        _exit(child_fork(&child, sleep_long, NULL, &error) &&
              child_receive(child.socket, &started, 1));
    }
    close(ends[1]);
    struct pollfd end = {.fd = ends[0], .events = POLLIN};
    assert_int_equal(poll(&end, 1, 20000), 1);
    assert_int_not_equal(end.revents & POLLHUP, 0);
    int status;
    assert_int_equal(waitpid(parent, &status, 0), parent);
    assert_int_equal(WEXITSTATUS(status), 1);
    close(ends[0]);
}

static void sleep_confined(int socket, const void *context)
{
    confine_process((TimeLimits){1, 1});
    sleep_long(socket, context);
}

static void *burn(void *context)
{
    for (;;)
        (void)*(volatile char *)context;
    return NULL;
}

// Two threads reach the limit of processor time before the equal limit of elapsed time.
static void burn_confined(int socket, const void *context)
{
    char byte = 0;
    pthread_t thread;
    (void)socket, (void)context;
    confine_process((TimeLimits){1, 1});
    pthread_create(&thread, NULL, burn, &byte);
    burn(&byte);
}

// Sends its limits of processor time: at first, after a file of 10 MB and after one of 1 TB.
static void send_limits(int socket, const void *context)
{
    static const uint64_t sizes[3] = {0, 10000000, 1000000000000};
    struct rlimit limits[3];
    (void)context;
    confine_process(reader_limits);
    for (int i = 0; i < 3; i++) {
        confine_add_time(sizes[i]);
        getrlimit(RLIMIT_CPU, &limits[i]);
    }
    child_send(socket, limits, sizeof limits);
}

TEST(processor_time_grows_with_the_files_read_up_to_a_limit)
{
    ChildProcess child;
    struct rlimit limits[3];
    start(&child, send_limits, NULL);
    assert_true(child_receive(child.socket, limits, sizeof limits));
    assert_int_equal(limits[0].rlim_cur, 8);
    assert_int_equal(limits[1].rlim_cur, 13);
    assert_int_equal(limits[2].rlim_cur, 120);
    child_end(&child);
}

// Returns the signal that ends the child.
static int expect_late(ChildWork *work)
{
    ChildProcess child;
    const ChildLimits limits = {.seconds = 60, .bytes = 10};
    FREED_BY(file_free) File output;
    Error error = {0};
    int signal;
    start(&child, work, NULL);
    assert_int_equal(child_collect(&child, &limits, &output, &signal, &error), CHILD_LATE);
    return signal;
}

// On a loaded machine, the time of day may end the child first.
TEST(a_confined_child_ends_after_its_processor_time)
{
    expect_late(burn_confined);
}

TEST(a_confined_child_ends_after_its_time)
{
    assert_int_equal(expect_late(sleep_confined), SIGALRM);
}

static atomic_bool has_spawned;

// Adds variables, so that the C library moves environ again and again.
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
        const bool is_spawned = child_spawn(&child, "/bin/true", "", &error);
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
    assert_true(child_spawn(&child, "/usr/bin/env", "-0", &error));
    // env closes its output before it ends, so child_collect may kill it in between.
    const ChildFate fate = child_collect(&child, &limits, &output, &signal, &error);
    assert_true(fate == CHILD_DONE || signal == SIGKILL);
    assert_null(memmem(output.bytes, output.size, "CLRT_TEST_LATE", strlen("CLRT_TEST_LATE")));
    const char *path = getenv("PATH");
    assert_non_null(memmem(output.bytes, output.size, path, strlen(path) + 1));
}
