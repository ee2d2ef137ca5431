// SPDX-License-Identifier: MIT
// All ray tracers trace the same rays, and one judge examines their hits.
#include "rig.h"

#include "exact.h"

Rig rig_open_with(const char *test, RayBatch *batch, Scene scene, TreeKind tree)
{
    Rig rig = {.test = test, .batch = batch};
    stage_make(&rig.stage, &scene, tree);
    scene_free(&scene);
    ray_batch_upload(batch, &rig.stage.flat);
    library_tracer_open(&rig.library, &rig.stage, batch);
    peers_open(&rig.peers, &rig.stage);
    return rig;
}

Rig rig_open(const char *test, RayBatch *batch, Scene scene)
{
    return rig_open_with(test, batch, scene, TREE_SAH);
}

void rig_close(Rig *rig)
{
    peers_close(&rig->peers);
    library_tracer_close(&rig->library);
    stage_free(&rig->stage);
}

// Returns NULL if this tracer does not trace the scene.
static TestHit *trace_by(const Rig *rig, RayTracer tracer, Rays rays)
{
    if (tracer == BY_CLRT)
        return ray_batch_trace(rig->batch, BATCH_NEAREST, rays);
    if (tracer == BY_LIBRARY)
        return rig->library.scene != NULL ? library_tracer_trace(&rig->library, rays) : NULL;
    return rig->peers.device != NULL ? peers_trace(&rig->peers, tracer, rays) : NULL;
}

Outcome rig_judge(const Rig *rig, Rays rays, Judge *is_wrong, void *context)
{
    Outcome outcome = {.test = rig->test,
                       .count = rays.count,
                       .has_library = rig->library.scene != NULL,
                       .has_peers = rig->peers.device != NULL};
    for (RayTracer tracer = BY_CLRT; tracer < TRACERS; tracer++) {
        TestHit *hits = trace_by(rig, tracer, rays);
        if (hits == NULL)
            continue;
        for (size_t i = 0; i < rays.count; i++)
            outcome.failures[tracer] +=
                is_wrong(context, &(Traced){&rays.data[i], &hits[i], i, tracer});
        free(hits);
    }
    return outcome;
}

bool judge_misses(void *unused, const Traced *traced)
{
    (void)unused;
    return traced->hit->id == NOTHING || !(traced->hit->t < INFINITY);
}

bool judge_exactly(void *triangles, const Traced *traced)
{
    const Verdict verdict = exact_nearest(triangles, traced->ray);
    return verdict.clear && verdict.id != traced->hit->id;
}
