// SPDX-License-Identifier: MIT
// Cuts each mesh into runs of equal length.
#include "scene/triangle_runs.h"

#define RUN_TRIANGLES 64

static TriangleRun run_of(const Mesh *mesh, size_t first)
{
    const size_t rest = mesh->triangle_count - first;
    TriangleRun run = {mesh,
                       first,
                       first + (rest < RUN_TRIANGLES ? rest : RUN_TRIANGLES),
                       {INFINITY, INFINITY, INFINITY},
                       {-INFINITY, -INFINITY, -INFINITY}};
    for (size_t triangle = first; triangle < run.end; triangle++)
        for (int corner = 0; corner < 3; corner++) {
            const Vec3 point = triangle_corner(mesh, triangle, corner);
            run.low = vec3_lower(run.low, point);
            run.high = vec3_upper(run.high, point);
        }
    return run;
}

bool triangle_runs_make(TriangleRuns *runs, const Scene *scene, Error *error)
{
    *runs = (TriangleRuns){.low = {INFINITY, INFINITY, INFINITY},
                           .high = {-INFINITY, -INFINITY, -INFINITY}};
    for (size_t i = 0; i < scene->objects.count; i++) {
        const Mesh *mesh = &scene->objects.data[i].mesh;
        for (size_t first = 0; first < mesh->triangle_count; first += RUN_TRIANGLES) {
            const TriangleRun run = run_of(mesh, first);
            if (!array_push(&runs->runs, run, error))
                return false;
            runs->low = vec3_lower(runs->low, run.low);
            runs->high = vec3_upper(runs->high, run.high);
        }
    }
    return true;
}

// Returns how far the box lies in a direction.
static double reach_of(const TriangleRun *run, Vec3 d)
{
    return fmax(d.x * run->low.x, d.x * run->high.x) + fmax(d.y * run->low.y, d.y * run->high.y) +
           fmax(d.z * run->low.z, d.z * run->high.z);
}

Vec3 triangle_runs_farthest(const TriangleRuns *runs, Vec3 direction)
{
    Vec3 farthest = {0, 0, 0};
    double most = -INFINITY;
    for (size_t i = 0; i < runs->runs.count; i++) {
        const TriangleRun *run = &runs->runs.data[i];
        if (reach_of(run, direction) <= most)
            continue;
        for (size_t triangle = run->first; triangle < run->end; triangle++)
            for (int corner = 0; corner < 3; corner++) {
                const Vec3 point = triangle_corner(run->mesh, triangle, corner);
                const double along = vec3_dot(point, direction);
                if (along > most) {
                    most = along;
                    farthest = point;
                }
            }
    }
    return farthest;
}
