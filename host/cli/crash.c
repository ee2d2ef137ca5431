// SPDX-License-Identifier: MIT
// Reports a crash, and names the library that contains the program counter. The message does not
// blame the library, because its caller may be at fault. For example, abort() stops in the C
// library, but its caller is at fault.
//
// LLVM installs its own handlers while it compiles a kernel. LLVM's SIGABRT handler does not call
// clrt's handler. If two threads crash at once, LLVM's other handlers do not restore clrt's
// handlers. LLVM's handlers of SIGINT, SIGTERM and SIGHUP let these signals interrupt writes. The
// executable therefore overrides the C library's sigaction and ignores requests to replace clrt's
// handlers. Only SIGFPE may get another handler: PoCL uses it to skip divisions by zero. The C
// library's signal() does not call the overridden function.
#include "cli/crash.h"

#include "cli/options/options.h"

#include <dlfcn.h>
#include <limits.h>
#include <link.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <ucontext.h>
#include <unistd.h>

static const int crashes[] = {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT};

static pid_t watcher;
static atomic_flag has_ended = ATOMIC_FLAG_INIT;
static const char *exit_message =
    "clrt: a driver ended the program, as LLVM does if a disk is full\n";

// Returns the program counter at the crash, or NULL on unknown processors.
static void *program_counter(const ucontext_t *context)
{
#if defined __x86_64__
    return (void *)context->uc_mcontext.gregs[REG_RIP];
#elif defined __aarch64__
    return (void *)context->uc_mcontext.pc;
#elif defined __riscv
    return (void *)context->uc_mcontext.__gregs[REG_PC];
#else
    (void)context;
    return NULL;
#endif
}

static void print_message(const char *message)
{
    const ssize_t written = write(STDERR_FILENO, message, strlen(message));
    (void)written; // if standard error is closed, there is no message
}

// Prints the message and ends the process. If several threads crash, only the first one prints a
// message.
static _Noreturn void end(const char *message)
{
    while (atomic_flag_test_and_set(&has_ended))
        pause();
    print_message(message);
    _exit(EXIT_DEVICE);
}

// Returns what to do after a crash in a driver. Two causes are known: PoCL aborts if it cannot
// store a kernel, or if it finds no linker.
static const char *advice(void)
{
    struct rlimit limit;
    if (getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
        return "): the limit on file sizes (ulimit -f) may be too small for the driver's files\n";
    if (getenv("PATH") == NULL)
        return "): PATH is not set, so the driver may not find a linker\n";
    return "): run clrt again; if it crashes again, try another --device, and report it\n";
}

// Handles a crash signal. Forked processes print no message. _dl_find_object takes no lock, unlike
// dladdr, whose lock the crashed thread may hold.
static void handle(int number, siginfo_t *info, void *context)
{
    char message[NAME_MAX + 160];
    struct dl_find_object found;
    const bool is_sent = info->si_code <= 0 && info->si_pid != getpid();
    const bool is_known = _dl_find_object(program_counter(context), &found) == 0;
    const char *path = is_known ? found.dlfo_link_map->l_name : NULL; // "" for the executable
    const bool is_own = is_known && path[0] == '\0';
    char *next = stpcpy(message, is_own ? "clrt: clrt itself crashed" : "clrt: crashed");
    const char *slash = is_known ? strrchr(path, '/') : NULL;
    if (slash != NULL)
        next = stpncpy(stpcpy(next, " in "), slash + 1, NAME_MAX);
    next = stpcpy(stpcpy(next, " (SIG"), sigabbrev_np(number));
    stpcpy(next, is_own ? "): please report it\n" : advice());
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
        end(exit_message);
}

#if !CLRT_TIDY_EXIT // sanitizers define sigaction themselves
static bool is_kept(int number)
{
    return number == SIGSEGV || number == SIGBUS || number == SIGILL || number == SIGABRT ||
           number == SIGINT || number == SIGTERM || number == SIGHUP;
}

// The C library's sigaction under its internal name.
extern int __sigaction(int number, const struct sigaction *action, struct sigaction *before);

__attribute__((visibility("default"))) int sigaction(int number, const struct sigaction *action,
                                                     struct sigaction *before)
{
    return __sigaction(number, watcher != 0 && is_kept(number) ? NULL : action, before);
}
#endif

void crash_expect_display(void)
{
    exit_message = "clrt: the display is gone, or a driver ended the program\n";
}

void crash_watch(void)
{
    struct sigaction action = {.sa_sigaction = handle, .sa_flags = SA_SIGINFO | SA_ONSTACK};
    sigemptyset(&action.sa_mask);
    for (size_t i = 0; i < sizeof crashes / sizeof *crashes; i++)
        sigaction(crashes[i], &action, NULL);
    watcher = getpid();
    atexit(handle_exit);
}
