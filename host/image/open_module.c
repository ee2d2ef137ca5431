// SPDX-License-Identifier: MIT
// In a build tree, the module is in the program's folder. An installed module is in the library
// folder.
#include "image/open_module.h"

#include "base/own_folder.h"

#include <dlfcn.h>
#include <stdio.h>
#include <unistd.h>

ModuleFunction *open_module(const char *name, Error *cause)
{
    char folder[PATH_MAX], path[2 * PATH_MAX];
    if (!own_folder(folder)) {
        error_set(cause, "the picture module cannot be found: /proc does not show where clrt is");
        return NULL;
    }
    snprintf(path, sizeof path, "%s/%s", folder, CLRT_IMAGE_MODULE);
    if (access(path, R_OK) != 0)
        snprintf(path, sizeof path, "%s/%s/%s", folder, CLRT_IMAGE_MODULE_FOLDER,
                 CLRT_IMAGE_MODULE);
    void *module = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    ModuleFunction *function = NULL;
    if (module != NULL)
        *(void **)&function = dlsym(module, name);
    if (function == NULL)
        error_set(cause, "the picture module cannot be opened: %s", dlerror());
    return function;
}
