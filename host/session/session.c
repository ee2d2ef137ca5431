// SPDX-License-Identifier: MIT
// Opens the device, and chooses and makes kernels. session_begin opens the device on a background
// thread while the caller's thread reads the scene. Making kernels on the background thread, too,
// would save no measurable time.
//
// Two choices save time and never change a picture. Small pictures use kernels that compile faster.
// Kernels are specialized for the scene if this saves more time than compiling takes (costs.h).
#include "session/session.h"

#include "base/clock.h"
#include "session/costs.h"

#include <string.h>

bool session_open(Session *session, Error *error)
{
    const SessionSettings *settings = &session->settings;
    const double start = clock_seconds();
    session->is_open = device_open(&session->device, settings->wanted.device, error);
    session->device_seconds = clock_seconds() - start;
    session->choice = kernel_choice_make(&settings->wanted, &session->device);
    session->kernels.source = (ProgramSource){.device = &session->device,
                                              .cache = &session->cache,
                                              .kernel_folder = settings->kernel_folder,
                                              .extra_options = settings->extra_options};
    return session->is_open &&
           kernel_choice_check_device(&session->choice, &session->device, error);
}

static void *run_thread(void *context)
{
    Session *session = context;
    session_open(session, &session->error);
    return NULL;
}

void session_begin(Session *session)
{
    session->is_running = device_thread_start(&session->thread, run_thread, session);
    if (!session->is_running) // fall back to the caller's thread
        run_thread(session);
}

// Returns whether the settings leave the choice of kernels to the session.
static bool leaves_kernels_open(const Session *session)
{
    const ClrtSettings *wanted = &session->settings.wanted;
    return wanted->kernel == CLRT_KERNEL_AUTO && wanted->precision == CLRT_FP32 &&
           wanted->tree != CLRT_TREE_NONE && wanted->specialize != CLRT_SPECIALIZE_ALWAYS;
}

static bool is_compiled(const Session *session, const KernelEntry *entry, KernelChoice choice)
{
    const SceneTraits general = traits_general((SceneTraits){0});
    const KernelSpec spec = {.entry = entry, .choice = choice, .traits = general};
    return kernel_set_has(&session->kernels, &spec);
}

// Pair kernels compile faster than packets, but trace more slowly. If packets are not in the cache,
// pair kernels draw small pictures of small scenes if this saves time in total. With a
// kernel_folder, the kernels that session_open chose draw all pictures.
static void choose_quick_kernels(Session *session, const SessionWork *work)
{
    const KernelChoice quick = {FAMILY_RAY, NODES_PAIR, 0, CLRT_FP32};
    if (work->counts || !leaves_kernels_open(session) || session->choice.family != FAMILY_PACKET ||
        session->settings.kernel_folder != NULL ||
        scene_triangle_count(session->scene.scene) >= QUICK_TRIANGLES ||
        is_compiled(session, work->entry, session->choice))
        return;
    const double saved = is_compiled(session, work->entry, quick) ? 0 : QUICK_COMPILE_SECONDS;
    const double lost = work->samples * SAVED_PER_SAMPLE / session->device.facts.compute_units +
                        LOST_OF_LIMIT * work->seconds;
    session->is_quick = lost <= PACKET_COMPILE_SECONDS - saved;
    if (session->is_quick)
        session->choice = quick;
}

static void join(Session *session)
{
    if (session->is_running)
        pthread_join(session->thread, NULL);
    session->is_running = false;
}

bool session_await(Session *session, const SessionWork *work, Error *error)
{
    join(session);
    if (session->error.text[0] != '\0')
        return error_set(error, "%s", session->error.text);
    if (work != NULL)
        choose_quick_kernels(session, work);
    return true;
}

bool session_save(Session *session)
{
    join(session);
    return kernel_set_save(&session->kernels);
}

void session_close(Session *session)
{
    session_save(session);
    session_scene_free(&session->scene);
    kernel_set_clear(&session->kernels);
    if (session->is_open)
        device_close(&session->device);
    *session = (Session){.settings = session->settings, .cache = session->cache};
}

// Returns whether a specialized program would omit a feature other than vertex colors. Omitting
// vertex colors saves no measurable time.
static bool lacks_features(const SceneTraits *traits)
{
    const SceneTraits general = traits_general(*traits);
    SceneTraits colored = *traits;
    colored.colors = general.colors;
    return memcmp(&colored, &general, sizeof general) != 0;
}

static bool specialization_pays(const Session *session, const KernelSpec *special,
                                const RenderSettings *settings)
{
    const double samples =
        (double)settings->width * settings->height * settings->samples * settings->samples;
    const double rate = RAYS_PER_SECOND * session->device.facts.compute_units;
    const double saving = SPECIALIZED_SAVES * samples * RAYS_PER_SAMPLE / rate;
    const ClrtSpecialize wanted = session->settings.wanted.specialize;
    if (wanted != CLRT_SPECIALIZE_AUTO)
        return wanted == CLRT_SPECIALIZE_ALWAYS;
    return kernel_set_has(&session->kernels, special) ||
           (session->settings.kernel_folder == NULL && saving > COMPILE_SECONDS &&
            lacks_features(&special->traits));
}

static KernelSpec spec_of(const Session *session, const RendererUse *use, const SceneTraits *traits)
{
    const ClrtSettings *settings = &session->settings.wanted;
    KernelSpec spec = {.entry = use->entry,
                       .choice = use->choice != NULL ? *use->choice : session->choice,
                       .traits = *traits};
    const bool is_own = use->choice == NULL;
    spec.group[0] = is_own ? settings->group_width : 0;
    spec.group[1] = is_own ? settings->group_height : 0;
    return spec;
}

const Kernel *session_kernel(Session *session, const RendererUse *use, const SceneTraits *traits,
                             Error *error)
{
    const KernelSpec spec = spec_of(session, use, traits);
    return kernel_set_get(&session->kernels, &spec, error);
}

bool session_renderer(Session *session, const RendererUse *use, const RenderSettings *settings,
                      Renderer *renderer, Error *error)
{
    const bool is_own = use->choice == NULL;
    SceneForm *form = is_own ? session_scene_own_form(session, error)
                             : session_scene_form(session, use->choice->nodes, true, error);
    if (form == NULL || (form->buffers.device == NULL &&
                         !scene_buffers_make(&form->buffers, &session->device, &form->flat, error)))
        return false;
    SceneTraits traits = form->buffers.traits;
    traits.statistics = use->counts;
    const KernelSpec special = spec_of(session, use, &traits);
    const bool is_special = !use->is_general && specialization_pays(session, &special, settings);
    if (!is_special)
        traits = traits_general(traits);
    *renderer = (Renderer){.kernel = session_kernel(session, use, &traits, error),
                           .scene = &form->buffers,
                           .settings = *settings,
                           .is_special = is_special};
    return renderer->kernel != NULL;
}

KernelChoice session_exact_choice(void)
{
    return (KernelChoice){FAMILY_RAY, NODES_PAIR, 0, CLRT_FP64};
}
