// SPDX-License-Identifier: MIT
// Opens and frees renderers, which are sessions with the caller's settings. Calls that draw or cast
// rays pass the scene to the session. Also lists the devices.
#include "library/handles.h"
#include "session/request.h"

#include <pthread.h>
#include <stdlib.h>

// Locked during calls that open drivers. PoCL 3.1 crashes if two threads make the first OpenCL
// calls concurrently. These calls may also change the environment while cache_open reads
// it.
static pthread_mutex_t opening = PTHREAD_MUTEX_INITIALIZER;

static bool open_session(Session *session, Error *cause)
{
    pthread_mutex_lock(&opening);
    cache_open(&session->cache);
    const bool ok = session_open(session, cause);
    pthread_mutex_unlock(&opening);
    return ok;
}

static bool check_settings(const ClrtSettings *given, ClrtError *error)
{
    return argument_number(error, "the precision", given->precision, 0, CLRT_FP64) &&
           argument_number(error, "the kernel", given->kernel, 0, CLRT_KERNEL_PACKET) &&
           argument_number(error, "specialize", given->specialize, 0, CLRT_SPECIALIZE_NEVER) &&
           argument_number(error, "the tree", given->tree, 0, CLRT_TREE_NONE) &&
           argument_number(error, "the group's width", given->group_width, 0, GROUP_SIDE_MOST) &&
           argument_number(error, "the group's height", given->group_height, 0, GROUP_SIDE_MOST);
}

static bool take_settings(ClrtSettings *wanted, const ClrtSettings *given, ClrtError *error)
{
    *wanted = (ClrtSettings){0};
    if (given != NULL && !argument_struct(error, "the settings", given, wanted, sizeof *wanted))
        return false;
    if (!check_settings(wanted, error))
        return false;
    return kernel_choice_is_valid(wanted) ||
           library_fail(error, CLRT_ARGUMENT,
                        "precision, kernel and lanes contradict each other: the wide and packet "
                        "kernels have 4, 8 or 16 lanes and no fp64");
}

ClrtRenderer *clrt_renderer_create(const ClrtSettings *settings, ClrtError *error)
{
    Error cause = {0};
    ClrtSettings wanted;
    if (!take_settings(&wanted, settings, error))
        return NULL;
    ClrtRenderer *renderer = memory_zeroed(1, sizeof *renderer, &cause);
    if (renderer != NULL) {
        renderer->session.settings.wanted = wanted;
        if (open_session(&renderer->session, &cause)) {
            renderer->session.settings.wanted.device = NULL; // the caller may free it
            return renderer;
        }
    }
    library_fail_for(error, CLRT_DEVICE, &cause);
    clrt_renderer_free(renderer);
    return NULL;
}

void clrt_renderer_free(ClrtRenderer *renderer)
{
    if (renderer == NULL)
        return;
    ray_caster_close(&renderer->caster);
    session_close(&renderer->session);
    free(renderer->batch);
    free(renderer);
}

bool renderer_handle_begin(ClrtRenderer *renderer, const ClrtScene *scene, ClrtError *error)
{
    if (!argument_given(error, "the renderer", renderer) ||
        !argument_given(error, "the scene", scene))
        return false;
    return !atomic_exchange(&renderer->is_busy, true) ||
           library_fail(error, CLRT_ARGUMENT, "the renderer is busy with another call");
}

void renderer_handle_end(ClrtRenderer *renderer)
{
    atomic_store(&renderer->is_busy, false);
}

bool renderer_handle_take(ClrtRenderer *renderer, const ClrtScene *scene, ClrtError *error)
{
    Error cause = {0};
    Session *session = &renderer->session;
    session->scene.scene = &scene->scene;
    if (renderer->state == scene->state)
        return true;
    renderer->state = 0;
    ray_caster_free_scenes(&renderer->caster);
    if (!session_scene_take(session, &scene->scene, &cause))
        return library_fail_for(error, CLRT_SCENE, &cause);
    renderer->state = scene->state;
    return true;
}

static bool list_devices(DeviceList *list, ClrtError *error)
{
    Error cause = {0};
    pthread_mutex_lock(&opening);
    const bool ok = device_list(list, &cause);
    pthread_mutex_unlock(&opening);
    return ok || library_fail_for(error, CLRT_DEVICE, &cause);
}

bool clrt_device_count(uint32_t *count, ClrtError *error)
{
    DeviceList list;
    if (!argument_given(error, "the count", count) || !list_devices(&list, error))
        return false;
    *count = list.count;
    return true;
}

bool clrt_device_get(uint32_t number, ClrtDevice *device, ClrtError *error)
{
    DeviceList list;
    if (!list_devices(&list, error))
        return false;
    if (number >= list.count)
        return library_fail(error, CLRT_ARGUMENT, "device %u does not exist: there are %u", number,
                            list.count);
    return argument_fill(error, "the device", device, &list.devices[number].facts, sizeof *device);
}
