// SPDX-License-Identifier: MIT
// The program: runs the command and prints its error.
#include "cli/command_files.h"
#include "cli/commands.h"
#include "cli/crash.h"
#include "cli/help.h"
#include "cli/options/parse.h"
#include "cli/stack.h"
#include "device/threads.h"

#include <signal.h>
#include <stdio.h>
#include <unistd.h>

static ExitCode show(Run *run, Error *error)
{
    return show_scene(run->options, &run->cache, error);
}

static ExitCode check(Run *run, Error *error)
{
    return check_scene(run->options, &run->cache, error);
}

static ExitCode perform_run(const Options *options, ExitCode perform_stages(Run *, Error *),
                            Error *error)
{
    Run run = {.options = options};
    run.report.options = options;
    run.report.settings = &run.settings;
    cache_open(&run.cache);
    threads_limit(options->threads);
    const ExitCode code = perform_stages(&run, error);
    run_free(&run);
    cache_close(&run.cache);
    return code;
}

static ExitCode perform(const Options *options, Error *error)
{
    switch (options->action) {
    case ACTION_HELP:
        options_write_help(stdout);
        return EXIT_DONE;
    case ACTION_VERSION:
        puts("clrt " CLRT_VERSION);
        return EXIT_DONE;
    case ACTION_LIST_DEVICES:
        return device_report_write(options->lists_json, error);
    case ACTION_WARM:
        return perform_run(options, warm_kernels, error);
    case ACTION_VIEW:
        return perform_run(options, show, error);
    case ACTION_CHECK:
        return perform_run(options, check, error);
    case ACTION_COMPARE:
        return compare_files(options, error);
    case ACTION_MERGE:
        return merge_parts(options, error);
    case ACTION_CONVERT:
        return convert_scene(options, error);
    case ACTION_EXPLAIN:
        return perform_run(options, explain_pixel, error);
    case ACTION_EXPLAIN_SCENE:
        return perform_run(options, explain_scene, error);
    case ACTION_RENDER:
        break;
    }
    return perform_run(options, picture_make, error);
}

static ExitCode perform_words(int count, char **words, Error *error)
{
    Options options;
    if (!options_parse(&options, count, words, error))
        return EXIT_USAGE;
    return command_files_check(&options, NULL, error) ? perform(&options, error) : EXIT_OUTPUT;
}

typedef struct {
    int count;
    char **words;
    ExitCode code;
} Start;

static void run(void *context)
{
    Start *start = context;
    Error error = {0};
    start->code = perform_words(start->count, start->words, &error);
    if (start->code <= EXIT_FAULTS && (fflush(stdout) != 0 || ferror(stdout))) {
        error_set(&error, "standard output cannot be written");
        start->code = EXIT_OUTPUT;
    }
    if (error.text[0] != '\0')
        fprintf(stderr, "clrt: %s\n", error.text);
}

int main(int count, char **words)
{
    Start start = {.count = count, .words = words};
    // With these signals ignored, a closed pipe or a file size limit makes writing fail, and clrt
    // reports the error.
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN);
    // Sanitizers install their own handlers and check for leaks at exit.
    if (!CLRT_TIDY_EXIT)
        crash_watch();
    stack_run(run, &start);
    // Drivers and libraries need 0.1 s to free their memory; the operating system frees it at once.
    if (!CLRT_TIDY_EXIT)
        _exit((int)start.code);
    return (int)start.code;
}
