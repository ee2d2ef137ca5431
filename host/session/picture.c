// SPDX-License-Identifier: MIT
// For a goal, the device traces samples in passes. Between passes, a thread pool on the host
// decides where to sample next.
#include "session/picture.h"

#include "base/clock.h"
#include "refine/adaptive.h"
#include "refine/ladder.h"
#include "render/tile_pass.h"
#include "scene/camera.h"
#include "session/costs.h"
#include "session/feature.h"

#include <math.h>
#include <stdlib.h>

// If the bound on max_level's error exceeds this fraction of the error goal, one more level saves
// more time than it costs.
#define TRUNCATED_MOST 0.9

typedef struct {
    const Session *session;
    SessionPicture *request;
    const RenderObserver *observer;
    Renderer renderer;
    const SceneForm *form;
    ThreadPool *pool; // for refining
    Framebuffer *framebuffer;
    PictureResult *result;
    double start; // clock time of the first sample for an error or time goal
} PictureDrawing;

const KernelEntry *picture_entry(const ClrtPicture *wanted)
{
    if (wanted->contrast > 0)
        return &sample_entry;
    return goal_is_given(wanted) ? &ladder_entry : &draw_entry;
}

// Returns the time that a pixel takes, in units of one sample of --aa.
static double samples_per_pixel(const SessionPicture *request)
{
    const ClrtPicture *goal = &request->wanted;
    if (goal->error > 0)
        return 1 + ERROR_SAMPLES / goal->error;
    if (goal->contrast > 0)
        return 1 + CONTRAST_SAMPLES / sqrt(goal->contrast);
    return (double)request->settings.samples * request->settings.samples;
}

SessionWork session_picture_work(const SessionPicture *request, double pictures)
{
    const double pixels = (double)request->settings.width * request->settings.height;
    return (SessionWork){.entry = picture_entry(&request->wanted),
                         .samples = pictures * pixels * samples_per_pixel(request),
                         .seconds = pictures * request->wanted.seconds,
                         .counts = request->wanted.statistics};
}

CameraData session_picture_camera(const Session *session, const SessionPicture *request,
                                  uint32_t samples)
{
    const RenderSettings *settings = &request->settings;
    return camera_make(&request->viewpoint, &session->scene.normalization,
                       render_whole_width(settings), render_whole_height(settings), samples);
}

void picture_result_free(PictureResult *result)
{
    free(result->pixel_samples);
    result->pixel_samples = NULL;
    certainty_map_free(&result->certainty);
}

static bool open_renderer(Session *session, const SessionPicture *request, Renderer *renderer,
                          PictureResult *result, Error *error)
{
    const RendererUse use = {.entry = picture_entry(&request->wanted),
                             .counts = request->wanted.statistics};
    if (!session_renderer(session, &use, &request->settings, renderer, error))
        return false;
    result->is_special = renderer->is_special;
    result->upload_size = renderer->scene->size;
    result->upload_seconds = renderer->scene->seconds;
    result->build_seconds = renderer->kernel->seconds;
    result->facts.cached = renderer->kernel->was_compiled;
    result->group[0] = renderer->kernel->launch.group[0];
    result->group[1] = renderer->kernel->launch.group[1];
    result->facts.truncation = request->truncated;
    return true;
}

bool session_prepare_picture(Session *session, const SessionPicture *request, PictureResult *result,
                             Error *error)
{
    Renderer renderer;
    return open_renderer(session, request, &renderer, result, error);
}

// In scenes with glass, measures the bound on the error of max_level: the root mean square of the
// weights that max_level cuts off in the samples. All samples taken before the call must be spread
// evenly.
static void measure_truncation(const PictureDrawing *drawing, uint64_t samples)
{
    const Renderer *renderer = &drawing->renderer;
    if (renderer->scene->traits.glass && renderer->settings.max_level > 0 && samples > 0)
        drawing->result->facts.truncation = renderer_truncation(renderer, samples);
}

// Returns the smallest feature. In refined pixels, only the samples of the first lines count,
// because later samples are not spread evenly.
static double adaptive_feature(const Adaptive *adaptive, size_t pixels)
{
    const uint64_t refined = adaptive->lines.pixels.count - 1;
    const SampleShare shares[2] = {{1, pixels - refined}, {FIRST_SAMPLES + 1, refined}};
    return feature_smallest(shares, 2);
}

static double ladder_feature(const Ladder *ladder)
{
    SampleShare shares[LADDER_RUNGS] = {{0}};
    for (uint32_t i = 0; i < STRATA_COUNT; i++) {
        const Stratum *stratum = &ladder->statistics.strata[i];
        SampleShare *share = &shares[strata_rung(i)];
        share->samples = ladder_samples[strata_rung(i)];
        share->pixels += stratum->entered - stratum->advanced;
    }
    return feature_smallest(shares, LADDER_RUNGS);
}

// Returns the inputs of a refinement with this camera.
static RefineSetup refine_setup(const PictureDrawing *drawing, Renderer *renderer,
                                const CameraData *camera)
{
    return (RefineSetup){.renderer = renderer,
                         .flat = &drawing->form->flat,
                         .camera = camera,
                         .pool = drawing->pool,
                         .scene = drawing->session->scene.scene,
                         .pieces = drawing->session->scene.pieces.data,
                         .normalization = &drawing->session->scene.normalization,
                         .picture = drawing->framebuffer,
                         .observer = drawing->observer};
}

static bool draw_adaptively(PictureDrawing *drawing, Error *error)
{
    Adaptive adaptive;
    PictureResult *result = drawing->result;
    const CameraData camera =
        session_picture_camera(drawing->session, drawing->request, REFINE_GRID);
    const RefineSetup setup = refine_setup(drawing, &drawing->renderer, &camera);
    bool ok = adaptive_open(&adaptive, &setup, error);
    measure_truncation(drawing, adaptive.samples);
    ok = ok && adaptive_refine(&adaptive, (float)drawing->request->wanted.contrast, error);
    if (ok)
        result->facts.smallest_feature = adaptive_feature(&adaptive, result->pixels);
    for (size_t i = 0; ok && result->pixel_samples != NULL && i < result->pixels; i++)
        result->pixel_samples[i] = adaptive_pixel_samples(&adaptive, i);
    result->facts.sample_count = adaptive.samples;
    adaptive_close(&adaptive);
    return ok;
}

// Refines toward the time or error goal. `truncated` is the part of the error goal that max_level
// uses up. If `truncated` uses up the whole goal, does nothing.
static bool refine(const PictureDrawing *drawing, Ladder *ladder, double truncated,
                   GoalOutcome *outcome, Error *error)
{
    const ClrtPicture *wanted = &drawing->request->wanted;
    const double left = wanted->error * wanted->error - truncated * truncated;
    const Goal goal = {sqrt(fmax(left, 0)), drawing->start, wanted->seconds};
    return (left <= 0 && wanted->seconds <= 0) || ladder_refine(ladder, &goal, outcome, error);
}

// Returns whether the rays that max_level cut off so far take so much of the error goal that one
// more level saves samples.
static bool needs_level(const PictureDrawing *drawing, const Ladder *ladder)
{
    const SessionPicture *request = drawing->request;
    return request->level_bound > 0 && request->wanted.error > 0 &&
           request->settings.max_level < GLASS_LEVELS &&
           drawing->result->facts.truncation > TRUNCATED_MOST * request->wanted.error &&
           sampler_is_whole(ladder->setup.renderer);
}

// Opens a ladder, which takes a sample in each pixel. If max_level causes too much of an error
// goal, adds a level and opens the ladder again.
static bool open_ladder(PictureDrawing *drawing, const RefineSetup *setup, Ladder *ladder,
                        Error *error)
{
    RenderSettings *settings = &drawing->request->settings;
    while (ladder_open(ladder, setup, error)) {
        measure_truncation(drawing, ladder->samples);
        if (!needs_level(drawing, ladder))
            return true;
        ladder_close(ladder);
        drawing->renderer.settings.max_level = ++settings->max_level;
    }
    return false;
}

static bool draw_for_goal(PictureDrawing *drawing, Error *error)
{
    Ladder ladder;
    GoalOutcome outcome = {0};
    PictureResult *result = drawing->result;
    drawing->start = clock_seconds();
    const CameraData camera =
        session_picture_camera(drawing->session, drawing->request, LADDER_GRID);
    const RefineSetup setup = refine_setup(drawing, &drawing->renderer, &camera);
    if (!open_ladder(drawing, &setup, &ladder, error))
        return false;
    const double truncated = drawing->request->includes_truncated ? result->facts.truncation : 0;
    const bool ok = refine(drawing, &ladder, truncated, &outcome, error);
    result->facts.error = hypot(outcome.estimate, truncated);
    result->facts.error_bound = hypot(outcome.bound, truncated);
    result->facts.goal_missed = !outcome.reached;
    result->facts.sample_count = ladder.samples;
    result->facts.smallest_feature = ladder_feature(&ladder);
    for (size_t i = 0; result->pixel_samples != NULL && i < ladder.statistics.pixels; i++)
        result->pixel_samples[i] = ladder_pixel_samples(&ladder, i);
    ladder_close(&ladder);
    return ok;
}

static bool draw_refined(PictureDrawing *drawing, Error *error)
{
    const RenderSettings *settings = &drawing->request->settings;
    PictureResult *result = drawing->result;
    result->pixels = (uint64_t)settings->width * settings->height;
    if (drawing->request->channels != 0 && result->pixel_samples == NULL) {
        result->pixel_samples = memory_raw(result->pixels, sizeof *result->pixel_samples, error);
        if (result->pixel_samples == NULL)
            return false;
    }
    drawing->pool = thread_pool_open(drawing->session->settings.wanted.threads);
    const bool ok = drawing->request->wanted.contrast > 0 ? draw_adaptively(drawing, error)
                                                          : draw_for_goal(drawing, error);
    thread_pool_close(drawing->pool);
    return ok;
}

static bool draw_evenly(PictureDrawing *drawing, Error *error)
{
    const RenderSettings *settings = &drawing->request->settings;
    PictureResult *result = drawing->result;
    Renderer *renderer = &drawing->renderer;
    const CameraData camera =
        session_picture_camera(drawing->session, drawing->request, settings->samples);
    if (!tile_pass_draw(renderer, &camera, drawing->observer, drawing->framebuffer, error))
        return false;
    result->pixels = 0;
    for (uint64_t number = settings->ready_tiles; number < renderer->progress.tiles_done;
         number++) {
        const Tile tile = tile_at(settings, number);
        result->pixels += (uint64_t)tile.width * tile.height;
    }
    const SampleShare all = {settings->samples * settings->samples, 1};
    result->facts.sample_count = result->pixels * all.samples;
    result->facts.smallest_feature = feature_smallest(&all, 1);
    measure_truncation(drawing, result->facts.sample_count);
    return true;
}

bool session_draw_picture(Session *session, SessionPicture *request, const RenderObserver *observer,
                          Framebuffer *framebuffer, PictureResult *result, Error *error)
{
    PictureDrawing drawing = {.session = session,
                              .request = request,
                              .observer = observer,
                              .framebuffer = framebuffer,
                              .result = result};
    if (!open_renderer(session, request, &drawing.renderer, result, error))
        return false;
    drawing.form = session_scene_own_form(session, error);
    const bool ok = goal_is_given(&request->wanted)
                        ? session_scene_find_pieces(session, error) && draw_refined(&drawing, error)
                        : draw_evenly(&drawing, error);
    result->progress = drawing.renderer.progress;
    result->is_complete = ok && result->progress.tiles_done == result->progress.tiles;
    return ok;
}

bool session_certify_picture(Session *session, const SessionPicture *request,
                             const RenderObserver *observer, Framebuffer *framebuffer,
                             PictureResult *result, Error *error)
{
    Renderer renderer;
    const KernelChoice exact = session_exact_choice();
    const RendererUse use = {.entry = &certify_entry, .choice = &exact, .is_general = true};
    const CameraData camera = session_picture_camera(session, request, request->settings.samples);
    const CertifiedPicture picture = {framebuffer, &result->certainty};
    if (!aov_needs(request->channels, AOV_NEEDS_CERTAINTY))
        return true;
    return certifier_check_device(&session->device, error) &&
           certainty_map_make(&result->certainty, framebuffer->width, framebuffer->height, error) &&
           session_renderer(session, &use, &request->settings, &renderer, error) &&
           certifier_certify(&renderer, &camera, observer, &picture, error);
}

bool session_draw_channels(Session *session, const SessionPicture *request,
                           const RenderObserver *observer, Layers *layers,
                           const PictureResult *result, Error *error)
{
    const bool counts = aov_needs(request->channels, AOV_NEEDS_TESTS);
    const RendererUse paths = {.entry = &paths_entry, .counts = counts, .is_general = true};
    const RendererUse tests = {.entry = &tests_entry, .counts = true, .is_general = true};
    const SessionScene *scene = &session->scene;
    AovPass pass = {.set = request->channels,
                    .layers = layers,
                    .camera = session_picture_camera(session, request, request->settings.samples),
                    .center = session_picture_camera(session, request, 1),
                    .samples = result->pixel_samples,
                    .normalization = &scene->normalization,
                    .light_count = (uint32_t)scene->scene->lights.count,
                    .certainty = result->certainty.marks != NULL ? &result->certainty : NULL};
    if (!session_renderer(session, &paths, &request->settings, &pass.paths, error))
        return false;
    SceneTraits traits = pass.paths.scene->traits;
    traits.statistics = true;
    traits = traits_general(traits);
    if (counts)
        pass.tests = session_kernel(session, &tests, &traits, error);
    return (!counts || pass.tests != NULL) && aov_draw(&pass, observer, error);
}
