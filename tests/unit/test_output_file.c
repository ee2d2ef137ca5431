// SPDX-License-Identifier: MIT
// Tests that files appear complete or not at all, without effects on the rest of the process.
#include "base/output_file.h"

#include "unit/cmocka_all.h"

#include <stdlib.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

static char folder[] = "/tmp/clrt-output-XXXXXX";
static int mask_changes;

// Overrides the C library's function.
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

// The mask applies to all threads. If it changed, files of other threads could become readable by
// everyone.
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

SET_UP(enter_folder)
{
    return mkdtemp(folder) == NULL || chdir(folder) != 0;
}

// Fails if files are left in the folder.
TEAR_DOWN(leave_folder)
{
    return rmdir(folder);
}
