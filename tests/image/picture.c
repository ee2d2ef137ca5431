// SPDX-License-Identifier: MIT
// Runs the stages one after another. If a stage fails, its result is empty. Consecutive pictures
// with the same compiler options and GPU share a session, so their kernels are compiled or loaded
// once.
#include "image/picture.h"

#include "image/form.h"
#include "image/shared_cache.h"
#include "scene/camera.h"
#include "scene/scn.h"

#include <stdlib.h>
#include <string.h>

typedef struct {
    const PictureRequest *request;
    Session *session;
    Scene scene;
    SessionPicture picture;
    PictureResult result;
} Pipeline;

PictureRequest picture_request(const char *scene_path, uint32_t view)
{
    const char *units = getenv("CLRT_TEST_GPU");
    return (PictureRequest){.scene_path = scene_path,
                            .view = view,
                            .samples = 1,
                            .max_level = -1,
                            .uses_bvh = true,
                            .builder = BVH_SAH,
                            .tile_width = 128,
                            .tile_height = 128,
                            .specialization = CLRT_SPECIALIZE_NEVER,
                            .gpu_units = units != NULL ? (uint32_t)atoi(units) : 0,
                            .choice = form_choice()};
}

static bool load(Pipeline *pipeline, Error *error)
{
    const PictureRequest *request = pipeline->request;
    if (request->scene != NULL)
        pipeline->scene = *request->scene;
    else if (!scn_load(&pipeline->scene, request->scene_path, &(SceneLoadOptions){0}, error))
        return false;
    if (request->view < 1 || request->view > pipeline->scene.viewpoints.count)
        return error_set(error, "%s has no view %u", request->scene_path, request->view);
    return request->has_last_tree ||
           session_scene_take(pipeline->session,
                              request->scene != NULL ? request->scene : &pipeline->scene, error);
}

static RenderSettings settings_of(const PictureRequest *request, const Scene *scene)
{
    return (RenderSettings){
        .width = request->width > 0 ? request->width : scene->width,
        .height = request->height > 0 ? request->height : scene->height,
        .samples = request->samples,
        .max_level = request->max_level >= 0 ? (uint32_t)request->max_level : scene->max_level,
        .tile_width = request->tile_width,
        .tile_height = request->tile_height,
    };
}

static bool draw_with_callback(Pipeline *pipeline, Framebuffer *framebuffer, Error *error)
{
    Renderer renderer;
    const PictureRequest *request = pipeline->request;
    const RendererUse use = {.entry = &sample_entry};
    const CameraData camera =
        session_picture_camera(pipeline->session, &pipeline->picture, request->samples);
    return session_renderer(pipeline->session, &use, &pipeline->picture.settings, &renderer,
                            error) &&
           request->draw(request->draw_context, &renderer, &camera, framebuffer, error);
}

static bool draw_colors(Pipeline *pipeline, Framebuffer *framebuffer, Error *error)
{
    const PictureRequest *request = pipeline->request;
    if (request->draw != NULL)
        return draw_with_callback(pipeline, framebuffer, error);
    const bool ok = session_draw_picture(pipeline->session, &pipeline->picture, NULL, framebuffer,
                                         &pipeline->result, error);
    if (ok && request->sample_count != NULL && goal_is_given(&pipeline->picture.wanted))
        *request->sample_count = pipeline->result.facts.sample_count;
    return ok && (!pipeline->result.facts.goal_missed || error_set(error, "the goal is missed"));
}

static bool draw_layers(Pipeline *pipeline, Error *error)
{
    Layers *layers = pipeline->request->layers;
    const RenderSettings *settings = &pipeline->picture.settings;
    if (layers == NULL)
        return true;
    *layers = (Layers){0};
    pipeline->picture.channels = pipeline->request->aovs;
    aov_name_layers(pipeline->picture.channels, layers);
    return layers_make(layers, settings->width, settings->height, error) &&
           session_draw_channels(pipeline->session, &pipeline->picture, NULL, layers,
                                 &pipeline->result, error);
}

static bool visit(Pipeline *pipeline, const Framebuffer *framebuffer, Error *error)
{
    Explainer explainer;
    const PictureRequest *request = pipeline->request;
    const SessionPicture *picture = &pipeline->picture;
    if (request->visit == NULL)
        return true;
    if (!explainer_open(&explainer, pipeline->session, &picture->settings, &picture->viewpoint,
                        error))
        return false;
    request->visit(&explainer, framebuffer, request->visit_context);
    explainer_close(&explainer);
    return true;
}

static bool draw(Pipeline *pipeline, Framebuffer *framebuffer, Error *error)
{
    const PictureRequest *request = pipeline->request;
    const RenderSettings settings = settings_of(request, &pipeline->scene);
    pipeline->picture =
        (SessionPicture){.settings = settings,
                         .viewpoint = pipeline->scene.viewpoints.data[request->view - 1],
                         .wanted = {.contrast = (double)request->contrast,
                                    .error = request->error_goal,
                                    .statistics = request->tallies != NULL}};
    return framebuffer_make(framebuffer, settings.width, settings.height, error) &&
           draw_colors(pipeline, framebuffer, error) && draw_layers(pipeline, error) &&
           visit(pipeline, framebuffer, error);
}

static Session session;

// Makes clrt treat the device as a GPU with memory of its own.
static void pretend_gpu(Device *device, uint32_t units)
{
    device->is_cpu = device->shares_memory = false;
    device->facts.compute_units = units;
}

// Returns the number of lanes that packets have by default, or 0 if it is unknown
// (kernels/lanes.cl).
static uint32_t usual_lanes(const Device *device)
{
#ifdef __x86_64__
    if (getenv("POCL_KERNELLIB_NAME") == NULL &&
        strcmp(device->facts.platform, "Portable Computing Language") == 0)
        return __builtin_cpu_supports("avx512f") ? 16 : __builtin_cpu_supports("avx") ? 8 : 4;
#endif
    (void)device;
    return 0;
}

// Opens the session at the first request, and whenever the compiler's options or the GPU change.
// Specialized programs and programs with options are not saved, because saving takes longer than
// drawing their pictures. The session stays open, because some implementations of OpenCL cannot be
// called at exit.
static bool open_session(const PictureRequest *request, Error *error)
{
    static uint32_t units;
    const char *options = request->extra_options;
    const char *older = session.settings.extra_options;
    if (session.is_open && (options != older || units != request->gpu_units))
        session_close(&session);
    const bool is_kept = options == NULL && request->specialization != CLRT_SPECIALIZE_ALWAYS;
    session.cache = is_kept ? *shared_cache() : (Cache){0};
    const ClrtTree builder = request->builder == BVH_MIDPOINT ? CLRT_TREE_MIDPOINT : CLRT_TREE_SAH;
    session.settings =
        (SessionSettings){.wanted = {.device = getenv("CLRT_DEVICE"),
                                     .threads = request->threads,
                                     .specialize = request->specialization,
                                     .tree = request->uses_bvh ? builder : CLRT_TREE_NONE,
                                     .group_width = request->group_width,
                                     .group_height = request->group_height},
                          .kernel_folder = getenv("CLRT_KERNEL_DIR"),
                          .extra_options = options};
    const bool ok = session.is_open || session_open(&session, error);
    units = request->gpu_units;
    if (units > 0)
        pretend_gpu(&session.device, units);
    session.choice = form_on_device(&request->choice, &session.device);
    // Choosing the default would compile the same programs twice.
    if (session.choice.lanes == usual_lanes(&session.device))
        session.choice.lanes = 0;
    return ok;
}

bool picture_render(Framebuffer *framebuffer, const PictureRequest *request, Error *error)
{
    Pipeline pipeline = {.request = request, .session = &session};
    *framebuffer = (Framebuffer){0};
    const bool ok = open_session(request, error) && load(&pipeline, error) &&
                    draw(&pipeline, framebuffer, error);
    if (ok && request->tallies != NULL)
        memcpy(request->tallies, pipeline.result.progress.tallies,
               sizeof pipeline.result.progress.tallies);
    session_save(&session);
    if (request->scene == NULL) {
        session_scene_free(&session.scene);
        scene_free(&pipeline.scene);
    }
    return ok;
}
