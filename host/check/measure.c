// SPDX-License-Identifier: MIT
// Takes the census of a scene, and counts the leaks of each mesh. For each mesh, compiles a scene
// that contains only this mesh, two-sided and in the normalized coordinates of the whole scene.
// Then casts rays at the mesh's edges and points (check/aims.h), and counts the rays that pass
// through.
#include "check/measure.h"

#include "check/aims.h"
#include "session/ray_caster.h"

#include <stdlib.h>
#include <string.h>

bool check_measure(Check *check, Error *error)
{
    check->normalization = normalization_of(check->scene);
    normalization_check(&check->normalization, check->scene, &check->scale_fault);
    return census_take(&check->census, check->scene, &check->normalization, error);
}

// All data that the leak test makes from one mesh.
typedef struct {
    Scene scene; // borrows the mesh
    SceneForm form;
    Aims aims;
} StagedMesh;

static bool make_aims(StagedMesh *staged, const Mesh *mesh, bool is_inside_out, Error *error)
{
    Edges edges = {0};
    const AimSource source = {.mesh = mesh,
                              .triangles = &staged->form.stages.triangles,
                              .edges = &edges,
                              .is_inside_out = is_inside_out};
    const bool ok =
        edges_make(&edges, mesh, error) && aims_make(&staged->aims, &source, LEAKS_AIMS, error);
    edges_free(&edges);
    return ok;
}

typedef struct {
    RayBlock *blocks;
    uint32_t *targets;
    HitData *hits;
} AimedRays;

static bool make_aimed_rays(AimedRays *batch, size_t count, Error *error)
{
    *batch = (AimedRays){memory_raw(count / RAY_BLOCK + 1, sizeof *batch->blocks, error),
                         memory_raw(count, sizeof *batch->targets, error),
                         memory_raw(count, sizeof *batch->hits, error)};
    return batch->blocks != NULL && batch->targets != NULL && batch->hits != NULL;
}

static bool trace_aims(StagedMesh *staged, MeshCensus *census, RayCaster *caster, Error *error)
{
    Aims *aims = &staged->aims;
    size_t (*const make_rays[2])(Aims *, RayBlock *, uint32_t *) = {aims_shoot_from_afar,
                                                                    aims_shoot_from_close};
    AimedRays batch;
    bool ok = make_aimed_rays(&batch, aims->count, error);
    for (int from = 0; ok && from < 2; from++) {
        const size_t rays = make_rays[from](aims, batch.blocks, batch.targets);
        for (size_t first = 0; ok && first < rays; first += CAST_RAYS) {
            const RayCast cast = {
                .query = RAYS_NEAREST,
                .scene = &staged->form.buffers,
                .count = (cl_uint)(rays - first < CAST_RAYS ? rays - first : CAST_RAYS),
                .room = 1};
            memcpy(caster->blocks.data, batch.blocks + first / RAY_BLOCK,
                   range_count(cast.count, RAY_BLOCK) * sizeof *batch.blocks);
            ok = ray_caster_cast(caster, &cast, error);
            if (ok)
                memcpy(batch.hits + first, caster->hits.data, cast.count * sizeof *batch.hits);
        }
        if (ok)
            aims_judge(aims, batch.targets, batch.hits, rays);
        census->facts.ray_count += rays;
    }
    free(batch.blocks);
    free(batch.targets);
    free(batch.hits);
    return ok;
}

static void sum_up(const Aims *aims, const MeshObject *given, MeshCensus *census)
{
    ClrtCheckedMesh *facts = &census->facts;
    facts->aim_count = aims->total;
    for (size_t i = 0; i < aims->count; i++) {
        const Aim *aimed = &aims->aims[i];
        facts->aimed_at += aimed->state != AIM_UNTRIED;
        facts->hidden += aimed->state == AIM_HIDDEN;
        if (aimed->state == AIM_LEAKED)
            mesh_fault_add(&census->leaks,
                           (size_t)scene_number_in_file(given, aimed->star.triangle));
    }
    facts->leaks = census->leaks.count;
    if (facts->closed)
        census->faults[FAULT_LEAKS] = census->leaks;
}

// Fills the facts about aims, rays and leaks in *census.
static bool count_mesh_leaks(MeshCensus *census, RayCaster *caster, const MeshObject *given,
                             const Normalization *normalization, const Session *session,
                             Error *error)
{
    StagedMesh staged = {0};
    MeshObject object = {.mesh = given->mesh, .two_sided = true};
    SceneForm *form = &staged.form;
    const FlatSource source = {.scene = &staged.scene,
                               .normalization = normalization,
                               .layout = caster->kernels[RAYS_NEAREST]->choice.nodes,
                               .has_tree = session->settings.wanted.tree != CLRT_TREE_NONE};
    bool ok = scene_init(&staged.scene, error) &&
              array_push(&staged.scene.objects, object, error) &&
              session_scene_compile(session, &source, form, error) &&
              make_aims(&staged, &given->mesh, census->facts.inside_out, error) &&
              scene_buffers_make(&form->buffers, &session->device, &form->flat, error) &&
              trace_aims(&staged, census, caster, error);
    sum_up(&staged.aims, given, census);
    aims_free(&staged.aims);
    scene_form_free(form);
    if (staged.scene.objects.count > 0)
        staged.scene.objects.data[0].mesh = (Mesh){0}; // the caller owns the mesh
    scene_free(&staged.scene);
    return ok;
}

static bool count_leaks(Check *check, const Session *session, RayCaster *caster, Error *error)
{
    bool ok = true;
    for (size_t object = 0; ok && object < check->scene->objects.count; object++) {
        const MeshObject *given = &check->scene->objects.data[object];
        if (given->mesh.triangle_count > 0)
            ok = count_mesh_leaks(&check->census.meshes[object], caster, given,
                                  &check->normalization, session, error);
    }
    return ok;
}

bool check_trace(Check *check, Session *session, Error *error)
{
    RayCaster caster = {0};
    const bool ok = ray_caster_open(&caster, session, RAYS_NEAREST, false, error) &&
                    count_leaks(check, session, &caster, error);
    ray_caster_close(&caster);
    check->device = ok ? session->device.facts.name : NULL;
    return ok;
}

void check_free(Check *check)
{
    free(check->findings.memory);
    census_free(&check->census);
    *check = (Check){0};
}
