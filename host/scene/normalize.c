// SPDX-License-Identifier: MIT
// Computes center and scale from the scene's bounds, and rejects scenes with objects that are too
// far away, too large or too small for float.
#include "scene/normalize.h"

#define LARGEST_RATIO 0x1p40

typedef struct {
    Vec3 low, high;
} SceneBox;

static void bounds_add(SceneBox *bounds, Vec3 point)
{
    bounds->low = vec3_lower(bounds->low, point);
    bounds->high = vec3_upper(bounds->high, point);
}

static SceneBox bounds_of(const Scene *scene)
{
    SceneBox bounds = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (size_t i = 0; i < scene->objects.count; i++)
        mesh_add_bounds(&scene->objects.data[i].mesh, &bounds.low, &bounds.high);
    if (scene_triangle_count(scene) > 0)
        return bounds;
    for (size_t i = 0; i < scene->spheres.count; i++) {
        const Sphere *sphere = &scene->spheres.data[i];
        const Vec3 reach = {sphere->radius, sphere->radius, sphere->radius};
        bounds_add(&bounds, vec3_sub(sphere->center, reach));
        bounds_add(&bounds, vec3_add(sphere->center, reach));
    }
    return bounds;
}

// Returns the longest side; a negative number if the scene has no objects.
static double extent_of(const SceneBox *bounds)
{
    return bounds->low.x <= bounds->high.x ? vec3_extent(vec3_sub(bounds->high, bounds->low)) : -1;
}

double scene_extent(const Scene *scene)
{
    const SceneBox bounds = bounds_of(scene);
    return extent_of(&bounds);
}

Normalization normalization_of(const Scene *scene)
{
    const SceneBox bounds = bounds_of(scene);
    const double extent = extent_of(&bounds);
    if (extent < 0)
        return (Normalization){{0, 0, 0}, 1};
    return (Normalization){vec3_scale(vec3_add(bounds.low, bounds.high), 0.5),
                           extent > 0 ? scalbn(1, -ilogb(extent)) : 1};
}

Vec3 normalize_point(const Normalization *normalization, Vec3 point)
{
    return vec3_scale(vec3_sub(point, normalization->center), normalization->scale);
}

Vec3 denormalize_point(const Normalization *normalization, Vec3 point)
{
    return vec3_add(vec3_scale(point, 1 / normalization->scale), normalization->center);
}

static bool is_near(const Normalization *normalization, Vec3 point)
{
    return vec3_extent(normalize_point(normalization, point)) <= LARGEST_RATIO;
}

static bool sphere_fits(const Normalization *normalization, const Sphere *sphere)
{
    const double radius = sphere->radius * normalization->scale;
    return is_near(normalization, sphere->center) && radius <= LARGEST_RATIO &&
           radius >= 1 / LARGEST_RATIO;
}

bool normalization_check(const Normalization *normalization, const Scene *scene, Error *error)
{
    for (size_t i = 0; i < scene->lights.count; i++)
        if (!is_near(normalization, scene->lights.data[i].position))
            return error_set(error, "light %zu is more than 5e11 times the scene's size away",
                             i + 1);
    for (size_t i = 0; i < scene->viewpoints.count; i++)
        if (!is_near(normalization, scene->viewpoints.data[i].eye))
            return error_set(error, "camera %zu is more than 5e11 times the scene's size away",
                             i + 1);
    for (size_t i = 0; i < scene->spheres.count; i++)
        if (!sphere_fits(normalization, &scene->spheres.data[i]))
            return error_set(error,
                             "sphere %zu is more than 5e11 times the scene's size away, or its "
                             "radius is not within a factor of 1e12 of that size",
                             i + 1);
    return true;
}
