// SPDX-License-Identifier: MIT
// The program clrt: parses the command line, runs the command and prints its error.
#include "base/processors.h"
#include "cli/commands.h"
#include "cli/crash.h"
#include "cli/options/options.h"
#include "cli/progress.h"

#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <unistd.h>

// Limits the number of PoCL's threads to `count`. If `count` is 0 and the user has not set PoCL's
// variables, the limit is processors_usable(), because PoCL ignores the quotas of control groups.
// PoCL 3.1 and 6.0 read different variables.
static void limit_threads(uint32_t count)
{
    char text[16];
    const uint32_t usable = processors_usable();
    if (count == 0 && usable >= processors_present())
        return;
    snprintf(text, sizeof text, "%u", count > 0 ? count : usable);
    setenv("POCL_MAX_PTHREAD_COUNT", text, count > 0);
    setenv("POCL_CPU_MAX_CU_COUNT", text, count > 0);
}

// Runs a command on a session. Closes the session only if CLRT_TIDY_EXIT is set, because drivers
// are slow to close.
static ExitCode perform_traced(const Options *options, TracingCommand *command, Error *error)
{
    Session session = {0};
    Scene scene = {0};
    cache_private_open(&session.cache);
    if (progress_on_terminal() && !options->quiet)
        session.cache.announce = progress_show_compiling;
    limit_threads(options->renderer.threads);
    const ExitCode code = command(options, &session, &scene, error);
    if (CLRT_TIDY_EXIT)
        session_close(&session);
    else
        session_save(&session);
    scene_free(&scene);
    cache_private_close(&session.cache);
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
    case ACTION_DEVICES:
        return devices_print(options, error);
    case ACTION_WARM:
        return perform_traced(options, warm_kernels, error);
    case ACTION_VIEW:
        crash_expect_display();
        return perform_traced(options, show_scene, error);
    case ACTION_CHECK:
        return perform_traced(options, check_scene, error);
    case ACTION_COMPARE:
        return compare_files(options, error);
    case ACTION_MERGE:
        return merge_parts(options, error);
    case ACTION_CONVERT:
        return convert_scene(options, error);
    case ACTION_EXPLAIN:
        return perform_traced(options, explain_pixel, error);
    case ACTION_EXPLAIN_SCENE:
        return perform_traced(options, explain_scene, error);
    case ACTION_RENDER:
        break;
    }
    return perform_traced(options, picture_make, error);
}

static ExitCode run_arguments(int count, char **arguments, Error *error)
{
    Options options;
    if (!options_parse(&options, count, arguments, error))
        return EXIT_USAGE;
    return command_files_check(&options, NULL, error) ? perform(&options, error) : EXIT_OUTPUT;
}

typedef struct {
    int count;
    char **arguments;
    ExitCode code;
} CommandLine;

// Returns whether standard output is a pipe that its reader has closed, as `| head` does.
static bool is_reader_gone(void)
{
    struct pollfd output = {.fd = STDOUT_FILENO};
    return poll(&output, 1, 0) == 1 && (output.revents & POLLERR) != 0;
}

static void *run(void *context)
{
    CommandLine *line = context;
    Error error = {0};
    line->code = run_arguments(line->count, line->arguments, &error);
    const bool is_written = fflush(stdout) == 0 && !ferror(stdout);
    if (line->code <= EXIT_FAULTS && !is_written) {
        if (!is_reader_gone())
            error_set(&error, "standard output cannot be written");
        line->code = EXIT_OUTPUT;
    }
    if (error.text[0] != '\0')
        fprintf(stderr, "clrt: %s\n", error.text);
    return NULL;
}

// RLIMIT_STACK limits the main thread's stack and is the default size of other threads' stacks.
#define STACK_LEAST ((rlim_t)8 << 20)
#define STACK_SIZE  ((size_t)16 << 20)

static bool run_on_thread(void *(*work)(void *context), void *context)
{
    pthread_t thread;
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, STACK_SIZE);
    pthread_setattr_default_np(&attributes);
    const bool ok = pthread_create(&thread, &attributes, work, context) == 0;
    pthread_attr_destroy(&attributes);
    if (ok)
        pthread_join(thread, NULL);
    return ok;
}

// Calls work(context) with a stack that is large enough for compilers, regardless of `ulimit -s`.
// Returns when `work` has returned. If the limit of `ulimit -s` is below 8 MiB, `work` runs on a
// new thread with a larger stack, and threads of drivers get larger stacks too.
static void run_with_stack(void *(*work)(void *context), void *context)
{
    struct rlimit limit;
    const bool is_small = getrlimit(RLIMIT_STACK, &limit) == 0 && limit.rlim_cur < STACK_LEAST;
    if (!is_small || !run_on_thread(work, context))
        work(context);
}

// Opens each closed standard stream so that reading or writing it fails. Otherwise, the next file
// that clrt opens would become the stream.
static void hold_closed_streams(void)
{
    for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; stream++)
        if (fcntl(stream, F_GETFD) < 0)
            open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

int main(int count, char **arguments)
{
    CommandLine line = {.count = count, .arguments = arguments};
    hold_closed_streams();
    // If these signals are ignored, a write to a closed pipe or beyond the limit on file sizes
    // returns an error, which clrt reports.
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN);
    // Builds with sanitizers (CLRT_TIDY_EXIT) keep the crash handlers of the sanitizers.
    if (!CLRT_TIDY_EXIT)
        crash_watch();
    run_with_stack(run, &line);
    // Drivers and libraries take 0.1 s to free their memory. The operating system frees it at once.
    if (!CLRT_TIDY_EXIT)
        _exit((int)line.code);
    return (int)line.code;
}
