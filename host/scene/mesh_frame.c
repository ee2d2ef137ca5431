// SPDX-License-Identifier: MIT
// The eye is at a fixed distance. The edges of the picture are planes through the eye. For each
// axis of the picture, two planes of the same slope are found that touch the meshes.
#include "scene/mesh_load.h"

#include "base/limits.h"

#include <stdlib.h>

#define VIEWS         6
#define DISTANCE      4.0 // of the eye from the center, in radii
#define FILLED        0.8 // part of the picture's width or height
#define RUN_TRIANGLES 64
#define MOST_STEPS    32

#define DEGREES_PER_RADIAN 57.295779513082320877

// A short run of a mesh's triangles with its bounding box, by which a search skips most runs.
// Neighbors in a file are usually neighbors in space.
typedef struct {
    Mesh mesh; // borrowed
    Vec3 low, high;
} Run;

typedef struct {
    ARRAY(Run) runs;
    Vec3 center;
    double distance;
} Frame;

static bool add_runs(Frame *frame, const Mesh *mesh, Error *error)
{
    for (size_t first = 0; first < mesh->triangle_count; first += RUN_TRIANGLES) {
        const size_t rest = mesh->triangle_count - first;
        Run run = {*mesh, {INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
        run.mesh.triangles += first;
        run.mesh.triangle_count = rest < RUN_TRIANGLES ? rest : RUN_TRIANGLES;
        mesh_add_bounds(&run.mesh, &run.low, &run.high);
        if (!array_push(&frame->runs, run, error))
            return false;
    }
    return true;
}

static Vec3 farthest(const Frame *frame, Vec3 d)
{
    Vec3 found = frame->center;
    double most = -INFINITY;
    for (size_t i = 0; i < frame->runs.count; i++) {
        const Run *run = &frame->runs.data[i];
        if (fmax(d.x * run->low.x, d.x * run->high.x) + fmax(d.y * run->low.y, d.y * run->high.y) +
                fmax(d.z * run->low.z, d.z * run->high.z) <=
            most)
            continue;
        for (size_t corner = 0; corner < 3 * run->mesh.triangle_count; corner++) {
            const uint32_t *vertices = run->mesh.triangles[corner / 3];
            const Vec3 point = vec3_of_doubles(run->mesh.positions[vertices[corner % 3]]);
            if (vec3_dot(point, d) > most) {
                most = vec3_dot(point, d);
                found = point;
            }
        }
    }
    return vec3_sub(found, frame->center);
}

// Returns the slope of the planes that touch the meshes on both sides of an axis, and stores the
// coordinate of their intersection on the axis. The gap between the planes and the meshes is a
// convex, piecewise linear function of the slope, so Newton's method ends after few steps.
static double touch(const Frame *frame, Vec3 axis, Vec3 back, double *middle)
{
    double slope = -1, next = 0;
    for (int step = 0; step < MOST_STEPS && next != slope; step++) {
        slope = next;
        const Vec3 inward = vec3_scale(back, slope);
        const Vec3 high = farthest(frame, vec3_add(inward, axis));
        const Vec3 low = farthest(frame, vec3_sub(inward, axis));
        const double above = frame->distance - vec3_dot(high, back);
        const double below = frame->distance - vec3_dot(low, back);
        next = (vec3_dot(high, axis) - vec3_dot(low, axis)) / (above + below);
        *middle = vec3_dot(high, axis) - next * above;
    }
    return next;
}

// Returns the field of view in which planes of this slope enclose the filled part. Newton's method
// starts above the result, where the tangent is convex, and stays above.
static double field_of_view(double slope)
{
    double half = 45;
    for (int step = 0; step < MOST_STEPS; step++) {
        const double sine = sine_of_degrees(half), cosine = cosine_of_degrees(half);
        half -= (sine - slope / FILLED * cosine) * cosine * DEGREES_PER_RADIAN;
    }
    return fmax(2 * half, FOV_LEAST);
}

// back points from the meshes to the eye.
static Viewpoint view_from(const Frame *frame, Vec3 back, Vec3 up)
{
    double right, top;
    const Vec3 x = vec3_normalize(vec3_cross(up, back)), y = vec3_cross(back, x);
    const double width = touch(frame, x, back, &right), height = touch(frame, y, back, &top);
    const Vec3 aside = vec3_add(vec3_scale(x, right), vec3_scale(y, top));
    const Vec3 look_at = vec3_add(frame->center, aside);
    return (Viewpoint){.eye = vec3_add(look_at, vec3_scale(back, frame->distance)),
                       .look_at = look_at,
                       .up = up,
                       .fov_degrees = field_of_view(height),
                       .width_degrees = field_of_view(width)};
}

bool mesh_frame_add_views(Scene *scene, Vec3 center, double radius, Error *error)
{
    static const Vec3 directions[VIEWS] = {{3, -4.5, 2}, {0, -1, 0}, {1, 0, 0},
                                           {0, 1, 0},    {-1, 0, 0}, {0, 0, 1}};
    Frame frame = {.center = center, .distance = DISTANCE * radius};
    bool ok = true;
    for (size_t i = 0; ok && i < scene->objects.count; i++)
        ok = add_runs(&frame, &scene->objects.data[i].mesh, error);
    for (int view = 0; ok && view < VIEWS; view++) {
        const Vec3 up = view == VIEWS - 1 ? vec3(0, 1, 0) : vec3(0, 0, 1);
        const Viewpoint viewpoint = view_from(&frame, vec3_normalize(directions[view]), up);
        ok = array_push(&scene->viewpoints, viewpoint, error);
    }
    free(frame.runs.memory);
    return ok;
}
