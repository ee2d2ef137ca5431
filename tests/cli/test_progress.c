// SPDX-License-Identifier: MIT
// Tests the remaining time that clrt prints to a log.
#include "base/clock.h"
#include "cli/progress.h"
#include "unit/cmocka_all.h"

#include <stdio.h>
#include <unistd.h>

// Stores the progress text of a picture that began `seconds` ago.
static void tell(char *text, size_t size, double seconds, const RenderProgress *render)
{
    Progress progress = {.start = clock_seconds() - seconds};
    FILE *log = tmpfile();
    const int before = dup(STDERR_FILENO);
    assert_non_null(log);
    fflush(stderr);
    dup2(fileno(log), STDERR_FILENO);
    assert_true(progress_tile_done(&progress, render));
    fflush(stderr);
    dup2(before, STDERR_FILENO);
    close(before);
    rewind(log);
    text[fread(text, 1, size - 1, log)] = '\0';
    fclose(log);
}

TEST(the_time_left_follows_from_the_tiles_that_this_run_has_done)
{
    char text[128];
    tell(text, sizeof text, 10.2, &(RenderProgress){.tiles_done = 25, .tiles = 100});
    assert_string_equal(text, "tracing 25 %, 31 s left\n");
    tell(text, sizeof text, 10.1,
         &(RenderProgress){.tiles_done = 60, .tiles = 100, .tiles_ready = 50});
    assert_string_equal(text, "tracing 60 %, 40 s left\n");
}
