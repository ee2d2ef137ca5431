// SPDX-License-Identifier: MIT
// If preloaded, this library imitates a driver that changes the environment. Meanwhile, another
// thread reads the environment, as OpenGL's libraries do.
#include <CL/cl.h>
#include <dlfcn.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

#define VARIABLES 2000

static atomic_bool is_changed;

static void *read_environment(void *context)
{
    (void)context;
    while (!is_changed)
        if (getenv("CLRT_TEST_NONE") != NULL)
            abort();
    return NULL;
}

static void change_environment(void)
{
    char name[32];
    for (int i = 0; i < VARIABLES; i++) {
        snprintf(name, sizeof name, "CLRT_TEST_%d", i);
        setenv(name, "1", 1);
    }
}

static void expect_environment(void)
{
    static char entry[] = "CLRT_TEST_1=2";
    if (setenv("CLRT_TEST_0", "2", 0) != 0 || getenv("CLRT_TEST_0")[0] != '1' ||
        putenv(entry) != 0 || getenv("CLRT_TEST_1")[0] != '2' || unsetenv("CLRT_TEST_1") != 0 ||
        getenv("CLRT_TEST_1") != NULL || setenv("A=B", "1", 1) == 0)
        abort();
}

cl_int clGetPlatformIDs(cl_uint size, cl_platform_id *platforms, cl_uint *count)
{
    cl_int (*real)(cl_uint, cl_platform_id *, cl_uint *);
    pthread_t reader;
    *(void **)&real = dlsym(RTLD_NEXT, "clGetPlatformIDs");
    pthread_create(&reader, NULL, read_environment, NULL);
    change_environment();
    expect_environment();
    is_changed = true;
    pthread_join(reader, NULL);
    return real(size, platforms, count);
}
