// SPDX-License-Identifier: MIT
// Runs the stages one after another. A stage that fails leaves an empty value.
#include "image/picture.h"

#include "accel/flat.h"
#include "image/form.h"
#include "render/aov_pass.h"
#include "scene/camera.h"
#include "scene/scn.h"

#include <stdlib.h>
#include <string.h>

typedef struct {
    const PictureRequest *request;
    Cache cache;
    Scene scene;
    Normalization normalization;
    FlatScene flat;
    Device device;
    Renderer renderer;
} Pipeline;

PictureRequest picture_request(const char *scene_path, uint32_t view)
{
    const KernelChoice choice = form_choice();
    const uint32_t group = form_group(&choice);
    return (PictureRequest){.scene_path = scene_path,
                            .view = view,
                            .samples = 1,
                            .max_level = -1,
                            .uses_bvh = true,
                            .builder = BVH_SAH,
                            .tile_width = 128,
                            .tile_height = 128,
                            .group_width = group,
                            .group_height = group,
                            .specialization = SPECIALIZE_NEVER,
                            .choice = choice};
}

static bool load(Pipeline *pipeline, Error *error)
{
    const PictureRequest *request = pipeline->request;
    if (request->scene != NULL)
        pipeline->scene = *request->scene;
    else if (!scn_load(&pipeline->scene, request->scene_path, &(SceneLoadOptions){0}, error))
        return false;
    pipeline->normalization = normalization_of(&pipeline->scene);
    if (request->view < 1 || request->view > pipeline->scene.viewpoints.count)
        return error_set(error, "%s has no view %u", request->scene_path, request->view);
    return normalization_check(&pipeline->normalization, &pipeline->scene, error);
}

static bool flatten(Pipeline *pipeline, Error *error)
{
    const CompileSource source = {.scene = &pipeline->scene,
                                  .normalization = &pipeline->normalization,
                                  .layout = pipeline->request->choice.nodes,
                                  .builder = pipeline->request->builder,
                                  .has_tree = pipeline->request->uses_bvh};
    return scene_compile(&pipeline->flat, NULL, &source, error);
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
        .group_width = request->group_width,
        .group_height = request->group_height,
        .statistics = request->tallies != NULL,
        .specialization = request->specialization,
    };
}

static CameraData camera_of(const Pipeline *pipeline, uint32_t samples)
{
    const uint32_t view = pipeline->request->view;
    return camera_make(&pipeline->scene.viewpoints.data[view - 1], &pipeline->normalization,
                       pipeline->renderer.settings.width, pipeline->renderer.settings.height,
                       samples);
}

static bool draw_adaptively(Pipeline *pipeline, const CameraData *camera, Framebuffer *framebuffer,
                            Error *error)
{
    Adaptive adaptive;
    const PictureRequest *request = pipeline->request;
    ThreadPool *pool = thread_pool_open(request->threads);
    const AdaptiveSetup setup = {&pipeline->renderer, &pipeline->flat,         camera, pool,
                                 &pipeline->scene,    &pipeline->normalization};
    const bool ok = adaptive_open(&adaptive, &setup, NULL, error) &&
                    adaptive_refine(&adaptive, request->contrast, NULL, error);
    if (ok)
        adaptive_store(&adaptive, framebuffer);
    if (ok && request->sample_count != NULL)
        *request->sample_count = adaptive.samples;
    adaptive_close(&adaptive);
    thread_pool_close(pool);
    return ok;
}

static bool draw_for_goal(Pipeline *pipeline, const CameraData *camera, Framebuffer *framebuffer,
                          Error *error)
{
    Ladder ladder;
    GoalOutcome outcome;
    const PictureRequest *request = pipeline->request;
    ThreadPool *pool = thread_pool_open(request->threads);
    const LadderSetup setup = {&pipeline->renderer, &pipeline->flat,          camera,      pool,
                               &pipeline->scene,    &pipeline->normalization, framebuffer, NULL};
    const bool ok = ladder_open(&ladder, &setup, error) &&
                    goal_reach_error(&ladder, request->error_goal, &outcome, error) &&
                    (outcome.reached || error_set(error, "the goal is missed"));
    if (ok && request->sample_count != NULL)
        *request->sample_count = ladder.samples;
    ladder_close(&ladder);
    thread_pool_close(pool);
    return ok;
}

static KernelEntry entry_of(const PictureRequest *request)
{
    if (request->contrast > 0 || request->draw != NULL)
        return KERNEL_SAMPLES;
    return request->error_goal > 0 ? KERNEL_LADDER : KERNEL_TILE;
}

static bool draw_colors(Pipeline *pipeline, Framebuffer *framebuffer, Error *error)
{
    const PictureRequest *request = pipeline->request;
    CameraData camera = camera_of(pipeline, request->samples);
    if (request->draw != NULL)
        return request->draw(request->draw_context, &pipeline->renderer, &camera, framebuffer,
                             error);
    switch (entry_of(request)) {
    case KERNEL_SAMPLES:
        camera = camera_of(pipeline, REFINE_GRID);
        return draw_adaptively(pipeline, &camera, framebuffer, error);
    case KERNEL_LADDER:
        camera = camera_of(pipeline, LADDER_GRID);
        return draw_for_goal(pipeline, &camera, framebuffer, error);
    default:
        return renderer_draw(&pipeline->renderer, &camera, NULL, framebuffer, error);
    }
}

static bool draw_layers(const Pipeline *pipeline, const RendererSetup *setup, Error *error)
{
    AovPass pass;
    Layers *layers = pipeline->request->layers;
    const AovSet aovs = pipeline->request->aovs;
    const RenderSettings *settings = &pipeline->renderer.settings;
    const AovSource source = {.setup = setup,
                              .renderer = &pipeline->renderer,
                              .camera = camera_of(pipeline, settings->samples),
                              .center = camera_of(pipeline, 1),
                              .scene = {&pipeline->normalization, pipeline->flat.light_count}};
    if (layers == NULL)
        return true;
    *layers = (Layers){0};
    aov_name_layers(aovs, layers);
    if (!layers_make(layers, settings->width, settings->height, error) ||
        !aov_pass_open(&pass, aovs, &source, error))
        return false;
    const bool ok = aov_pass_draw(&pass, NULL, layers, error);
    aov_pass_close(&pass);
    return ok;
}

static bool visit(const Pipeline *pipeline, const RendererSetup *setup,
                  const Framebuffer *framebuffer, Error *error)
{
    Explainer explainer;
    const PictureRequest *request = pipeline->request;
    const ExplainerSource source = {.setup = setup,
                                    .renderer = &pipeline->renderer,
                                    .scene = &pipeline->scene,
                                    .normalization = &pipeline->normalization,
                                    .camera =
                                        camera_of(pipeline, pipeline->renderer.settings.samples)};
    if (request->visit == NULL)
        return true;
    if (!explainer_open(&explainer, &source, error))
        return false;
    request->visit(&explainer, framebuffer, request->visit_context);
    explainer_close(&explainer);
    return true;
}

static bool draw(Pipeline *pipeline, Framebuffer *framebuffer, Error *error)
{
    const PictureRequest *request = pipeline->request;
    const RenderSettings settings = settings_of(request, &pipeline->scene);
    const RendererSetup setup = {.device = &pipeline->device,
                                 .cache = &pipeline->cache,
                                 .source = {.kernel_folder = getenv("CLRT_KERNEL_DIR"),
                                            .extra_options = request->extra_options,
                                            .choice = request->choice,
                                            .entry = entry_of(request)}};
    if (!device_open(&pipeline->device, getenv("CLRT_DEVICE"), error) ||
        !renderer_open(&pipeline->renderer, &setup, &pipeline->flat, &settings, error))
        return false;
    return framebuffer_make(framebuffer, settings.width, settings.height, error) &&
           draw_colors(pipeline, framebuffer, error) && draw_layers(pipeline, &setup, error) &&
           visit(pipeline, &setup, framebuffer, error);
}

bool picture_render(Framebuffer *framebuffer, const PictureRequest *request, Error *error)
{
    Pipeline pipeline = {.request = request};
    *framebuffer = (Framebuffer){0};
    cache_open(&pipeline.cache);
    const bool ok =
        load(&pipeline, error) && flatten(&pipeline, error) && draw(&pipeline, framebuffer, error);
    if (ok && request->tallies != NULL)
        memcpy(request->tallies, pipeline.renderer.progress.tallies,
               sizeof pipeline.renderer.progress.tallies);
    renderer_close(&pipeline.renderer);
    device_close(&pipeline.device);
    flat_free(&pipeline.flat);
    if (request->scene == NULL)
        scene_free(&pipeline.scene);
    cache_close(&pipeline.cache);
    return ok;
}
