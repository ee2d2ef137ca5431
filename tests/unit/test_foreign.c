// SPDX-License-Identifier: MIT
// Tests that clrt reports one message if clrt-foreign crashes, hangs, writes endlessly or is
// missing. Shell scripts replace clrt-foreign.
#undef _FORTIFY_SOURCE // otherwise, the system's headers define readlink
#include "base/foreign.h"

#include "base/clock.h"
#include "unit/cmocka_all.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

static char script[] = "/tmp/clrt_reader_XXXXXX";

static const char *const words[FOREIGN_WORDS] = {"m.obj"};

static bool is_without_proc;

// Overrides the C library's function to imitate a system without /proc.
ssize_t readlink(const char *restrict path, char *restrict target, size_t size)
{
    if (is_without_proc) {
        errno = ENOENT;
        return -1;
    }
    return syscall(SYS_readlinkat, AT_FDCWD, path, target, size);
}

static void write_script(const char *text)
{
    FILE *stream = fopen(script, "w");
    assert_non_null(stream);
    fprintf(stream, "#!/bin/sh\n%s\n", text);
    assert_int_equal(fclose(stream), 0);
    assert_int_equal(chmod(script, 0700), 0);
}

static bool run(const char *text, File *stream, Error *error)
{
    const ForeignReader reader = {"Assimp", script, 1, 100000};
    write_script(text);
    *error = (Error){0};
    return foreign_run(stream, &reader, words, error);
}

static void expect_failure(const char *text, const char *keyword)
{
    FREED_BY(file_free) File stream;
    Error error;
    const double start = clock_seconds();
    assert_false(run(text, &stream, &error));
    assert_non_null(strstr(error.text, keyword));
    assert_true(clock_seconds() - start < 10);
}

TEST(the_stream_is_the_output_of_the_program)
{
    FREED_BY(file_free) File stream;
    Error error;
    assert_true(run("echo about $1; sleep 0.1; echo more", &stream, &error));
    assert_int_equal(stream.size, strlen("about m.obj\nmore\n"));
    assert_memory_equal(stream.bytes, "about m.obj\nmore\n", stream.size);
}

TEST(a_program_that_crashes_stays_or_gives_up_is_one_sentence)
{
    const char *late = "Assimp took too long";
    expect_failure("echo part of it; kill -SEGV $$", "(signal 11)");
    expect_failure("kill -XCPU $$", late);
    expect_failure("kill -ALRM $$", late);
    expect_failure("exec sleep 60", late);
    expect_failure("while :; do echo; sleep 0.05; done", late);
    expect_failure("exec yes", "Assimp exceeded the limit");
    expect_failure("exec sleep 60 >/dev/null", "(signal 9)");
    expect_failure("exit 1", "clrt-foreign");
}

TEST(a_missing_program_is_reported)
{
    const ForeignReader reader = {"Assimp", "/nonexistent", 1, 1};
    File stream;
    Error error = {0};
    assert_false(foreign_run(&stream, &reader, words, &error));
    assert_non_null(strstr(error.text, "/nonexistent"));
    assert_non_null(strstr(error.text, "No such file"));
}

// The program in the current folder may belong to anybody.
TEST(a_program_of_that_name_in_the_current_folder_is_not_started)
{
    const ForeignReader reader = {"Assimp", NULL, 1, 1};
    char folder[] = "/tmp/clrt_folder_XXXXXX";
    FREED_BY(file_free) File stream = {0};
    Error error = {0};
    assert_non_null(mkdtemp(folder));
    assert_int_equal(chdir(folder), 0);
    write_script("echo > started");
    assert_int_equal(rename(script, "clrt-foreign"), 0);
    is_without_proc = true;
    assert_false(foreign_run(&stream, &reader, words, &error));
    is_without_proc = false;
    assert_int_not_equal(access("started", F_OK), 0);
    assert_int_equal(rename("clrt-foreign", script), 0);
    assert_int_equal(chdir("/") + rmdir(folder), 0);
}

// Runs the script without limits that matter.
static void collect(const char *text, File *stream)
{
    const ForeignReader reader = {"Assimp", script, 60, 20000000};
    Error error = {0};
    write_script(text);
    const bool ok = foreign_run(stream, &reader, words, &error);
    assert_string_equal(error.text, "");
    assert_true(ok);
}

TEST(a_long_output_arrives_whole)
{
    FREED_BY(file_free) File stream;
    collect("yes | head -c 10000000", &stream);
    assert_int_equal(stream.size, 10000000);
    for (size_t i = 0; i < stream.size; i += 2)
        assert_memory_equal(stream.bytes + i, "y\n", 2);
}

TEST(a_child_has_empty_streams)
{
    FREED_BY(file_free) File stream;
    collect("wc -c; test -t 1 || echo none; echo lost >&2", &stream);
    assert_int_equal(stream.size, strlen("0\nnone\n"));
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
        FREED_BY(file_free) File stream;
        collect("", &stream);
    }
    has_spawned = true;
    pthread_join(thread, NULL);
}

TEST(a_child_has_the_environment_of_the_start)
{
    FREED_BY(file_free) File stream;
    setenv("CLRT_TEST_LATE", "1", 1);
    collect("/usr/bin/env -0", &stream);
    assert_null(memmem(stream.bytes, stream.size, "CLRT_TEST_LATE", strlen("CLRT_TEST_LATE")));
    const char *path = getenv("PATH");
    assert_non_null(memmem(stream.bytes, stream.size, path, strlen(path) + 1));
}

SET_UP(make_script)
{
    const int file = mkstemp(script);
    return file < 0 ? -1 : close(file);
}

TEAR_DOWN(remove_script)
{
    return unlink(script);
}
