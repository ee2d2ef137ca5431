// SPDX-License-Identifier: MIT
// Draws with a session. When the scene or the kernels change, new objects are made before old ones
// are released. If the new objects cannot be made, the old ones remain in use.
#include "view/tracer.h"

bool tracer_open(ViewTracer *tracer, const TracerOptions *options, Error *error)
{
    *tracer = (ViewTracer){.options = options,
                           .session = {.settings = options->session, .cache = options->cache}};
    return session_open(&tracer->session, error);
}

void tracer_close(ViewTracer *tracer)
{
    session_close(&tracer->session);
    model_release(tracer->model);
    *tracer = (ViewTracer){0};
}

BvhSettings tracer_tree(const ViewTracer *tracer)
{
    return (BvhSettings){session_builder(&tracer->options->session.wanted),
                         flat_leaves(tracer->session.choice.nodes)};
}

// Compiles the scene and the kernels for the next pass.
static bool prepare(ViewTracer *tracer, Error *error)
{
    return session_prepare(&tracer->session, &(SessionPicture){0}, &tracer->drawn, error);
}

bool tracer_take(ViewTracer *tracer, Model *model, bool uses_bvh, Error *error)
{
    Session *session = &tracer->session;
    SessionScene before = session->scene;
    const ClrtTree tree = session->settings.wanted.tree;
    session->scene = (SessionScene){
        .scene = &model->scene, .normalization = model->normalization, .stages = &model->stages};
    session->settings.wanted.tree = uses_bvh ? CLRT_TREE_SAH : CLRT_TREE_NONE;
    if (!prepare(tracer, error)) {
        session_scene_free(&session->scene);
        session->scene = before;
        session->settings.wanted.tree = tree;
        return false;
    }
    Model *held = model_hold(model);
    session_scene_free(&before);
    model_release(tracer->model);
    tracer->model = held;
    return true;
}

bool tracer_renew(ViewTracer *tracer, Error *error)
{
    KernelSet before = tracer->session.kernels;
    tracer->session.kernels = (KernelSet){.source = before.source};
    const bool ok = prepare(tracer, error);
    kernel_set_clear(ok ? &before : &tracer->session.kernels);
    if (!ok)
        tracer->session.kernels = before;
    return ok;
}

RenderSettings tracer_settings(const ViewTracer *tracer, const Pass *pass)
{
    const int32_t level = tracer->options->max_level;
    const uint32_t given = level == CLRT_LEVEL_NONE ? 0 : (uint32_t)level;
    return (RenderSettings){.width = pass->width,
                            .height = pass->height,
                            .samples = pass->samples,
                            .max_level = level == 0 ? tracer->model->scene.max_level : given,
                            .tile_width = pass->tile,
                            .tile_height = pass->tile};
}

bool tracer_draw(ViewTracer *tracer, const Shot *shot, const RenderObserver *observer,
                 Framebuffer *framebuffer, Error *error)
{
    SessionPicture request = {.settings = tracer_settings(tracer, shot->pass),
                              .viewpoint = *shot->camera,
                              .wanted.statistics = shot->pass->kind == PASS_COUNT};
    return session_draw(&tracer->session, &request, observer, framebuffer, &tracer->drawn, error);
}

bool tracer_explain(ViewTracer *tracer, const Shot *shot, const ExplainReport *head, FILE *stream,
                    Error *error)
{
    Explainer explainer;
    const RenderSettings settings = tracer_settings(tracer, shot->pass);
    ExplainReport report = *head;
    report.scene = &tracer->model->scene;
    report.settings = &settings;
    if (!explainer_open(&explainer, &tracer->session, &settings, shot->camera, error))
        return false;
    const bool ok = explain_write_text(&report, &explainer, stream, error);
    explainer_close(&explainer);
    return ok;
}
