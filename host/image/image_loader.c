// SPDX-License-Identifier: MIT
// The module lies beside the program in a build tree and under the library folder once installed.
#include "image/image_loader.h"

#include <dlfcn.h>
#include <libgen.h>
#include <limits.h>
#include <pthread.h>
#include <stdio.h>
#include <unistd.h>

static struct {
    pthread_t thread;
    bool started;
    void *module;
    char message[512];
} loader = {.message = "no thread could be started for it"};

static void *open_module(void *unused)
{
    (void)unused;
    char program[PATH_MAX], path[2 * PATH_MAX];
    const ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    program[length > 0 ? length : 0] = '\0';
    const char *folder = dirname(program);
    snprintf(path, sizeof path, "%s/%s", folder, CLRT_IMAGE_MODULE);
    if (access(path, R_OK) != 0)
        snprintf(path, sizeof path, "%s/%s/%s", folder, CLRT_IMAGE_MODULE_FOLDER,
                 CLRT_IMAGE_MODULE);
    loader.module = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (loader.module == NULL)
        snprintf(loader.message, sizeof loader.message, "%s", dlerror());
    return NULL;
}

void image_loader_start(void)
{
    if (loader.started)
        return;
    loader.started = pthread_create(&loader.thread, NULL, open_module, NULL) == 0;
}

ImageModuleWrite *image_loader_finish(Error *error)
{
    static bool joined;
    image_loader_start();
    if (loader.started && !joined)
        joined = pthread_join(loader.thread, NULL) == 0;
    ImageModuleWrite *write = NULL;
    if (loader.module != NULL)
        *(void **)&write = dlsym(loader.module, IMAGE_MODULE_WRITE);
    if (write == NULL)
        error_set(error, "the picture module cannot be opened: %s", loader.message);
    return write;
}
