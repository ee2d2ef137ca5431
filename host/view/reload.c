// SPDX-License-Identifier: MIT
// Checks the files with stat, five times a second.
#include "view/reload.h"

#include "base/file.h"

#include <stdlib.h>

#define LOOK_SECONDS 0.2

static bool add_folder(Reload *reload, const char *path, Error *error)
{
    char *folder = file_path_beside(path, ".", error);
    const bool ok = folder != NULL && watch_add(&reload->scene, folder, error);
    free(folder);
    return ok;
}

bool reload_follow(Reload *reload, const Scene *scene, const char *path, bool has_failed,
                   Error *error)
{
    watch_begin(&reload->scene);
    bool ok = watch_add(&reload->scene, path, error);
    for (size_t i = 0; ok && scene != NULL && i < scene->inputs.count; i++)
        ok = watch_add(&reload->scene, scene->inputs.data[i], error);
    ok = ok && (!has_failed || add_folder(reload, path, error));
    watch_end(&reload->scene);
    return ok;
}

bool reload_follow_kernels(Reload *reload, const char *folder, Error *error)
{
    return folder == NULL || watch_add(&reload->kernels, folder, error);
}

unsigned reload_look(Reload *reload, double now)
{
    if (now - reload->looked < LOOK_SECONDS)
        return 0;
    reload->looked = now;
    return (watch_look(&reload->scene) ? RELOAD_SCENE : 0) |
           (watch_look(&reload->kernels) ? RELOAD_KERNELS : 0);
}

void reload_free(Reload *reload)
{
    watch_free(&reload->scene);
    watch_free(&reload->kernels);
}
