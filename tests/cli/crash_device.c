// SPDX-License-Identifier: MIT
// If preloaded, this library makes a driver crash at the first launch of a kernel. CLRT_CRASH
// selects the crash: "abort", "exit", "segv", "bus", "ill", "libc" (in a function of the C library)
// or "own" (in the program's code). With the suffix "-thread", a thread of the driver crashes. With
// the suffix "-two", two threads crash at once. "fpe" crashes at the first call of OpenCL instead,
// before PoCL installs its handler for divisions by zero.
#include <CL/cl.h>
#include <dlfcn.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/auxv.h>
#include <sys/mman.h>
#include <unistd.h>

static volatile int zero;

static void touch_lost_page(void)
{
    char path[] = "/tmp/clrt-crash-XXXXXX";
    const int file = mkstemp(path);
    const size_t size = (size_t)sysconf(_SC_PAGESIZE);
    unlink(path);
    if (ftruncate(file, (off_t)size) != 0)
        return;
    volatile char *page = mmap(NULL, size, PROT_READ, MAP_SHARED, file, 0);
    if (ftruncate(file, 0) == 0)
        zero = page[0];
}

// Crashes in the program's code: jumps to the halt instruction at the end of the entry code. The
// CPU forbids this instruction in user mode.
static void halt(void)
{
    void (*run)(void);
    const unsigned char *code = (const unsigned char *)getauxval(AT_ENTRY);
    const void *place = memchr(code, 0xf4, 64);
    memcpy(&run, &place, sizeof run);
    run();
}

static void *crash(void *context)
{
    const char *kind = context;
    if (strncmp(kind, "abort", 5) == 0)
        abort();
    if (strncmp(kind, "libc", 4) == 0)
        zero = (int)strlen((const char *)(size_t)zero);
    if (strncmp(kind, "exit", 4) == 0)
        exit(1);
    if (strncmp(kind, "segv", 4) == 0)
        *(volatile int *)(size_t)zero = 1;
    if (strncmp(kind, "bus", 3) == 0)
        touch_lost_page();
    if (strncmp(kind, "own", 3) == 0)
        halt();
    if (strncmp(kind, "ill", 3) == 0)
        __builtin_trap();
    return NULL;
}

cl_int clGetPlatformIDs(cl_uint size, cl_platform_id *platforms, cl_uint *count)
{
    cl_int (*real)(cl_uint, cl_platform_id *, cl_uint *);
    *(void **)&real = dlsym(RTLD_NEXT, "clGetPlatformIDs");
    if (strcmp(getenv("CLRT_CRASH"), "fpe") == 0)
        zero = 7 / zero;
    return real(size, platforms, count);
}

cl_int clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions,
                              const size_t *offset, const size_t *grid, const size_t *group,
                              cl_uint count, const cl_event *events, cl_event *event)
{
    (void)queue, (void)kernel, (void)dimensions, (void)offset, (void)grid, (void)group;
    (void)count, (void)events, (void)event;
    char *kind = getenv("CLRT_CRASH");
    pthread_t threads[2];
    const int thread_count = strstr(kind, "-two") != NULL ? 2 : strstr(kind, "-thread") != NULL;
    for (int i = 0; i < thread_count; i++)
        pthread_create(&threads[i], NULL, crash, kind);
    for (int i = 0; i < thread_count; i++)
        pthread_join(threads[i], NULL);
    crash(kind);
    return CL_OUT_OF_RESOURCES;
}
