// SPDX-License-Identifier: MIT
// Opens new objects before it closes old objects, so that the old objects remain in use after a
// failure.
#include "view/tracer.h"

#include "scene/camera.h"

bool tracer_open(Tracer *tracer, const TracerOptions *options, Error *error)
{
    *tracer = (Tracer){.options = options};
    if (!device_open(&tracer->device, options->device, error))
        return false;
    tracer->setup =
        (RendererSetup){.device = &tracer->device,
                        .cache = options->cache,
                        .source = {.kernel_folder = options->kernel_folder,
                                   .choice = kernel_choose(&options->kernel, &tracer->device)}};
    const KernelChoice *choice = &tracer->setup.source.choice;
    if (!kernel_check_device(choice, &tracer->device, error))
        return false;
    const uint32_t side = kernel_group_side(choice);
    tracer->group[0] = options->group_width > 0 ? options->group_width : side;
    tracer->group[1] = options->group_height > 0 ? options->group_height : side;
    return true;
}

static void drop_model(Tracer *tracer)
{
    renderer_close(&tracer->counter);
    renderer_close(&tracer->renderer);
    flat_free(&tracer->flat);
    model_release(tracer->model);
    tracer->model = NULL;
}

void tracer_close(Tracer *tracer)
{
    drop_model(tracer);
    if (tracer->device.context != NULL)
        device_close(&tracer->device);
    *tracer = (Tracer){0};
}

BvhSettings tracer_tree(const Tracer *tracer)
{
    return (BvhSettings){tracer->options->builder, flat_leaves(tracer->setup.source.choice.nodes)};
}

static bool flatten(FlatScene *flat, const Tracer *tracer, const Model *model, bool uses_bvh,
                    Error *error)
{
    const Bvh none = {0};
    ThreadPool *pool = thread_pool_open(tracer->options->threads);
    const FlatSource source = {&model->scene,
                               &model->triangles,
                               uses_bvh ? &model->bvh : &none,
                               &model->normalization,
                               tracer->setup.source.choice.nodes,
                               pool};
    const bool ok = flat_make(flat, &source, error);
    thread_pool_close(pool);
    return ok;
}

static uint32_t max_level(const Tracer *tracer, const Model *model)
{
    const int64_t wanted = tracer->options->max_level;
    return wanted >= 0 ? (uint32_t)wanted : model->scene.max_level;
}

// Returns the settings of a new renderer. Size and samples are placeholders, because each pass sets
// them.
static RenderSettings first_settings(const Tracer *tracer, const Model *model)
{
    return (RenderSettings){.width = 1,
                            .height = 1,
                            .samples = 1,
                            .max_level = max_level(tracer, model),
                            .tile_width = 1,
                            .tile_height = 1,
                            .group_width = tracer->group[0],
                            .group_height = tracer->group[1],
                            .specialization = tracer->options->specialization};
}

bool tracer_take(Tracer *tracer, Model *model, bool uses_bvh, Error *error)
{
    FlatScene flat = {0};
    Renderer renderer = {0};
    const RenderSettings settings = first_settings(tracer, model);
    if (!flatten(&flat, tracer, model, uses_bvh, error))
        return false;
    if (!renderer_open(&renderer, &tracer->setup, &flat, &settings, error)) {
        flat_free(&flat);
        return false;
    }
    Model *held = model_hold(model);
    drop_model(tracer);
    tracer->model = held;
    tracer->flat = flat;
    tracer->renderer = renderer;
    return true;
}

void tracer_save(Tracer *tracer)
{
    program_save(&tracer->renderer.program);
    program_save(&tracer->counter.program);
}

bool tracer_is_saved(const Tracer *tracer)
{
    return tracer->renderer.program.unsaved == NULL && tracer->counter.program.unsaved == NULL;
}

RenderSettings tracer_settings(const Tracer *tracer, const Pass *pass)
{
    RenderSettings settings = tracer->renderer.settings;
    settings.width = pass->width;
    settings.height = pass->height;
    settings.samples = pass->samples;
    settings.tile_width = settings.tile_height = pass->tile;
    return settings;
}

static bool prepare_counter(Tracer *tracer, Error *error)
{
    RenderSettings settings = first_settings(tracer, tracer->model);
    settings.statistics = true;
    return tracer->counter.kernel != NULL ||
           renderer_open(&tracer->counter, &tracer->setup, &tracer->flat, &settings, error);
}

static CameraData camera_of(const Tracer *tracer, const Shot *shot)
{
    return camera_make(shot->camera, &tracer->model->normalization, shot->pass->width,
                       shot->pass->height, shot->pass->samples);
}

bool tracer_draw(Tracer *tracer, const Shot *shot, const RenderObserver *observer,
                 Framebuffer *framebuffer, Error *error)
{
    const Pass *pass = shot->pass;
    const bool counts = pass->kind == PASS_COUNT;
    if (counts && !prepare_counter(tracer, error))
        return false;
    Renderer *renderer = counts ? &tracer->counter : &tracer->renderer;
    const RenderSettings settings = tracer_settings(tracer, pass);
    const CameraData data = camera_of(tracer, shot);
    renderer_resize(renderer, &settings);
    return renderer_draw(renderer, &data, observer, framebuffer, error);
}

const RenderProgress *tracer_progress(const Tracer *tracer, const Pass *pass)
{
    return pass->kind == PASS_COUNT ? &tracer->counter.progress : &tracer->renderer.progress;
}

bool tracer_explain(Tracer *tracer, const Shot *shot, const ExplainReport *head, FILE *stream,
                    Error *error)
{
    Explainer explainer;
    const Model *model = tracer->model;
    const RenderSettings settings = tracer_settings(tracer, shot->pass);
    const ExplainerSource source = {&tracer->setup, &tracer->renderer, &model->scene,
                                    &model->normalization, camera_of(tracer, shot)};
    ExplainReport report = *head;
    report.scene = &model->scene;
    report.settings = &settings;
    renderer_resize(&tracer->renderer, &settings);
    if (!explainer_open(&explainer, &source, error))
        return false;
    const bool ok = explain_write_text(&report, &explainer, stream, error);
    explainer_close(&explainer);
    return ok;
}
