// SPDX-License-Identifier: MIT
// Reports whether clrt or a driver crashed. The executable contains no drivers, libraries or
// kernels, and OpenCL never calls back into it. A program counter outside the executable therefore
// counts as a driver's crash. LLVM installs its own handlers while it compiles a kernel. LLVM's
// SIGABRT handler does not pass the signal on to ours. If two threads crash at once, LLVM's other
// handlers do not restore ours. The executable therefore overrides the C library's sigaction and
// ignores requests to replace our handlers. Only SIGFPE stays replaceable, because PoCL uses it to
// step over divisions by zero.
#include "cli/process.h"

#include "cli/options/options.h"

#include <signal.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <ucontext.h>
#include <unistd.h>

static const int crashes[] = {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT};

// The linker defines the bounds of the executable's code.
extern const char __executable_start[], etext[];

static pid_t watcher;
static atomic_flag has_ended = ATOMIC_FLAG_INIT;

static bool is_own_code(const ucontext_t *context)
{
#ifdef __x86_64__
    const greg_t place = context->uc_mcontext.gregs[REG_RIP];
    return place >= (greg_t)__executable_start && place < (greg_t)etext;
#else
    (void)context;
    return false;
#endif
}

static void print_message(const char *message)
{
    const ssize_t written = write(STDERR_FILENO, message, strlen(message));
    (void)written; // if standard error is closed, there is no message
}

// The first thread that gets here prints and exits; later threads wait for the exit.
static _Noreturn void end(const char *message)
{
    while (atomic_flag_test_and_set(&has_ended))
        pause();
    print_message(message);
    _exit(EXIT_DEVICE);
}

// Only the process that called crash_watch prints. Its forks, such as readers of pictures, do not.
static void handle(int number, siginfo_t *info, void *context)
{
    char message[160];
    const bool is_sent = info->si_code <= 0 && info->si_pid != getpid();
    const bool is_own = is_own_code(context);
    char *next =
        stpcpy(message, is_own ? "clrt: clrt itself crashed (SIG" : "clrt: a driver crashed (SIG");
    next = stpcpy(next, sigabbrev_np(number));
    stpcpy(next, is_own ? "): please report it\n"
                        : "): run clrt again; if it crashes again, try another --device\n");
    if (getpid() == watcher && !is_sent && !is_own)
        end(message);
    if (getpid() == watcher && !is_sent)
        print_message(message);
    signal(number, SIG_DFL);
    raise(number); // takes effect once this function has returned
}

static void handle_exit(void)
{
    if (getpid() == watcher)
        end("clrt: a driver ended the program, as LLVM does if a disk is full\n");
}

#if !CLRT_TIDY_EXIT // sanitizers define this function themselves
static bool is_kept(int number)
{
    return number == SIGSEGV || number == SIGBUS || number == SIGILL || number == SIGABRT;
}

// The C library's internal name of sigaction.
extern int __sigaction(int number, const struct sigaction *action, struct sigaction *before);

__attribute__((visibility("default"))) int sigaction(int number, const struct sigaction *action,
                                                     struct sigaction *before)
{
    return __sigaction(number, watcher != 0 && is_kept(number) ? NULL : action, before);
}
#endif

void crash_watch(void)
{
    struct sigaction action = {.sa_sigaction = handle, .sa_flags = SA_SIGINFO | SA_ONSTACK};
    sigemptyset(&action.sa_mask);
    for (size_t i = 0; i < sizeof crashes / sizeof *crashes; i++)
        sigaction(crashes[i], &action, NULL);
    watcher = getpid();
    atexit(handle_exit);
}
