// SPDX-License-Identifier: MIT
// Prepares a scene that contains only the mesh for the device, and casts rays at the mesh's edges
// and vertices (check/aims.h).
#include "check/leaks.h"

#include <stdlib.h>

// A mesh in every stage of preparation for the device, and its aims.
typedef struct {
    Scene scene; // borrows the mesh
    Triangles triangles;
    Bvh bvh;
    FlatScene flat;
    Aims aims;
} Staged;

static bool stage_mesh(Staged *staged, const RayCaster *caster, const LeakSetting *setting,
                       Error *error)
{
    const Scene *scene = &staged->scene;
    const BvhSettings tree = {setting->builder, flat_leaves(caster->nodes)};
    const FlatSource source = {.scene = scene,
                               .triangles = &staged->triangles,
                               .bvh = &staged->bvh,
                               .normalization = setting->normalization,
                               .layout = caster->nodes,
                               .crew = setting->crew};
    return triangles_make(&staged->triangles, scene, setting->normalization, setting->crew,
                          error) &&
           (!setting->uses_bvh ||
            bvh_build(&staged->bvh, &staged->triangles, &tree, setting->crew, error)) &&
           flat_make(&staged->flat, &source, error);
}

static bool aim(Staged *staged, const Mesh *mesh, const LeakSetting *setting, Error *error)
{
    Weld weld = {0};
    Edges edges = {0};
    const AimSource source = {.mesh = mesh,
                              .triangles = &staged->triangles,
                              .weld = &weld,
                              .edges = &edges,
                              .is_inside_out = setting->closedness->is_inside_out};
    const bool ok = weld_make(&weld, mesh, error) && edges_make(&edges, mesh, &weld, error) &&
                    aims_make(&staged->aims, &source, LEAKS_AIMS, error);
    edges_free(&edges);
    weld_free(&weld);
    return ok;
}

typedef struct {
    AimRay *rays;
    uint32_t *targets;
    float *distances;
} Volley;

static bool make_volley(Volley *volley, size_t count, Error *error)
{
    *volley = (Volley){memory_raw(count, sizeof *volley->rays, error),
                       memory_raw(count, sizeof *volley->targets, error),
                       memory_raw(count, sizeof *volley->distances, error)};
    return volley->rays != NULL && volley->targets != NULL && volley->distances != NULL;
}

static bool fire(Aims *aims, LeakCount *count, const RayCaster *caster, Error *error)
{
    size_t (*const shoot[2])(Aims *, AimRay *, uint32_t *) = {aims_shoot_from_afar,
                                                              aims_shoot_from_close};
    Volley volley;
    bool ok = make_volley(&volley, aims->count, error);
    for (int from = 0; ok && from < 2; from++) {
        const size_t rays = shoot[from](aims, volley.rays, volley.targets);
        ok = ray_caster_cast(caster, volley.rays, rays, volley.distances, error);
        if (ok)
            aims_judge(aims, volley.targets, volley.distances, rays);
        count->rays += rays;
    }
    free(volley.rays);
    free(volley.targets);
    free(volley.distances);
    return ok;
}

static void sum_up(const Aims *aims, LeakCount *count)
{
    count->total = aims->total;
    for (size_t i = 0; i < aims->count; i++) {
        const Aim *aimed = &aims->aims[i];
        count->aimed += aimed->state != AIM_UNTRIED;
        count->hidden += aimed->state == AIM_HIDDEN;
        if (aimed->state == AIM_LEAKED)
            mesh_fault_add(&count->leaks, aimed->triangle);
    }
}

bool leaks_count(LeakCount *count, RayCaster *caster, const Mesh *mesh, const LeakSetting *setting,
                 Error *error)
{
    Staged staged = {0};
    MeshObject object = {.mesh = *mesh, .two_sided = true};
    *count = (LeakCount){0};
    bool ok =
        scene_init(&staged.scene, error) && array_push(&staged.scene.objects, object, error) &&
        stage_mesh(&staged, caster, setting, error) && aim(&staged, mesh, setting, error) &&
        ray_caster_load(caster, &staged.flat, error) && fire(&staged.aims, count, caster, error);
    sum_up(&staged.aims, count);
    ray_caster_unload(caster);
    aims_free(&staged.aims);
    flat_free(&staged.flat);
    bvh_free(&staged.bvh);
    triangles_free(&staged.triangles);
    if (staged.scene.objects.count > 0)
        staged.scene.objects.data[0].mesh = (Mesh){0}; // the caller owns the mesh
    scene_free(&staged.scene);
    return ok;
}
