// SPDX-License-Identifier: MIT
// Tests that output files appear complete or not at all, without effects on the rest of the
// process.
#include "base/output_file.h"

#include "unit/cmocka_all.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

static char folder[] = "/tmp/clrt-output-XXXXXX";
static int mask_changes;

// Overrides the C library's function to count changes.
mode_t umask(mode_t mask)
{
    mask_changes++;
    return (mode_t)syscall(SYS_umask, mask);
}

static mode_t mode_of(const char *path)
{
    struct stat status;
    assert_int_equal(stat(path, &status), 0);
    return status.st_mode & 0777;
}

static void begin(OutputFile *file, const char *path)
{
    Error error = {0};
    assert_true(output_file_begin(file, path, &error));
}

TEST(a_file_gets_the_permissions_that_the_mask_leaves)
{
    OutputFile file;
    Error cause = {0};
    const mode_t before = umask(027);
    begin(&file, "picture");
    assert_true(output_file_end(&file, true, &cause));
    umask(before);
    assert_int_equal(mode_of("picture"), 0640);
    unlink("picture");
}

TEST(unfinished_files_of_one_name_are_two)
{
    OutputFile one, other;
    Error cause = {0};
    begin(&one, "picture");
    begin(&other, "picture");
    assert_string_not_equal(one.temporary, other.temporary);
    assert_true(output_file_end(&one, true, &cause));
    assert_false(output_file_end(&other, false, &cause));
    assert_int_equal(access("picture", F_OK), 0);
    unlink("picture");
}

// The process has one umask for all threads. If the umask changed, files of other threads could
// become readable by everyone.
TEST(the_mask_is_not_changed_even_for_a_moment)
{
    OutputFile file;
    Error cause = {0};
    const int before = mask_changes;
    assert_true(output_file_check("picture", &cause));
    begin(&file, "picture");
    assert_true(output_file_end(&file, true, &cause));
    assert_int_equal(mask_changes, before);
    unlink("picture");
}

static void make_file(const char *name)
{
    FILE *file = fopen(name, "wx");
    assert_non_null(file);
    fclose(file);
}

// Creates a temporary file as a killed run on another machine would leave it. Returns its name.
static const char *make_strange(void)
{
    static const char name[] = ".clrt-00000000deadbeef";
    make_file(name);
    return name;
}

// Creates a temporary file as a killed run on this machine would leave it. Returns its name, which
// the caller frees.
static char *make_lost(void)
{
    OutputFile file;
    begin(&file, "picture");
    char *name = file.temporary;
    close(file.lock);
    return name;
}

TEST(temporary_files_of_killed_runs_are_removed)
{
    static const char *const others[] = {".clrt-00000000deadbee", ".clrt-00000000deadbeeg",
                                         "clrt-00000000deadbeef"};
    Error error = {0};
    OutputFile living;
    char *lost = make_lost();
    begin(&living, "picture");
    for (int i = 0; i < 3; i++)
        make_file(others[i]);
    assert_true(output_file_check("picture", &error));
    assert_int_not_equal(access(lost, F_OK), 0);
    for (int i = 0; i < 3; i++)
        assert_int_equal(unlink(others[i]), 0);
    assert_true(output_file_end(&living, true, &error));
    assert_int_equal(unlink("picture"), 0);
    free(lost);
}

// On a network file system, locks of other machines may be invisible.
TEST(files_of_other_machines_stay_for_a_day)
{
    Error error = {0};
    char *lost = make_lost();
    const char *strange = make_strange();
    const struct timespec before[2] = {{.tv_sec = time(NULL) - 86500},
                                       {.tv_sec = time(NULL) - 86500}};
    assert_true(output_file_check("picture", &error));
    assert_int_not_equal(access(lost, F_OK), 0);
    assert_int_equal(access(strange, F_OK), 0);
    assert_int_equal(utimensat(AT_FDCWD, strange, before, 0), 0);
    assert_true(output_file_check("picture", &error));
    assert_int_not_equal(access(strange, F_OK), 0);
    free(lost);
}

SET_UP(enter_folder)
{
    return mkdtemp(folder) == NULL || chdir(folder) != 0;
}

// Fails if files are left in the folder.
TEAR_DOWN(leave_folder)
{
    return rmdir(folder);
}
