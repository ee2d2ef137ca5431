// SPDX-License-Identifier: MIT
// All scenes use the general kernels, so that a renderer compiles kernels only once.
#include "library/handles.h"

#include <pthread.h>
#include <stdlib.h>

static bool make_kernel(Session *session, Error *cause)
{
    const RendererUse use = {.entry = picture_entry(&(PictureGoal){0})};
    const SceneTraits traits = traits_general(false);
    return session_kernel(session, &use, &traits, cause) != NULL;
}

// Opens the device in one thread at a time. PoCL 3.1 crashes if two threads make the first OpenCL
// calls concurrently. These calls may change the environment, which cache_open_for_library reads.
static bool open_session(Session *session, Error *cause)
{
    static pthread_mutex_t opening = PTHREAD_MUTEX_INITIALIZER;
    pthread_mutex_lock(&opening);
    cache_open_for_library(&session->cache);
    const bool ok = session_open(session, cause) && make_kernel(session, cause);
    pthread_mutex_unlock(&opening);
    return ok;
}

ClrtRenderer *clrt_renderer_create(const char *device, uint32_t threads, ClrtError *error)
{
    Error cause = {0};
    ClrtRenderer *renderer = memory_zeroed(1, sizeof *renderer, &cause);
    if (renderer != NULL) {
        renderer->session.settings = (SessionSettings){
            .device = device, .threads = threads, .specialization = SPECIALIZE_NEVER};
        if (open_session(&renderer->session, &cause)) {
            renderer->session.settings.device = NULL; // the caller's
            return renderer;
        }
    }
    check_fail_for(error, CLRT_DEVICE, &cause);
    clrt_renderer_free(renderer);
    return NULL;
}

void clrt_renderer_free(ClrtRenderer *renderer)
{
    if (renderer == NULL)
        return;
    session_close(&renderer->session);
    free(renderer);
}

bool renderer_handle_take(ClrtRenderer *renderer, const ClrtScene *scene, ClrtError *error)
{
    Error cause = {0};
    Session *session = &renderer->session;
    PictureResult unused;
    session->scene.scene = &scene->scene;
    if (renderer->state == scene->state)
        return true;
    renderer->state = 0;
    if (!session_take(session, &scene->scene, &cause) || session_own_form(session, &cause) == NULL)
        return check_fail_for(error, CLRT_SCENE, &cause);
    if (!session_prepare(session, &(SessionPicture){0}, &unused, &cause))
        return check_fail_for(error, CLRT_DEVICE, &cause);
    renderer->state = scene->state;
    return true;
}
