// SPDX-License-Identifier: MIT
// Computes center and scale from the scene's bounds, and rejects scenes with objects that are too
// far away, too large or too small for float.
#include "scene/normalize.h"

// The camera's reach is its distance from the objects that it shows (reach_of). The scene counts as
// coarse for the camera if the scene's bounding box is this many times as large as the reach. With
// the box's center as the origin, rounding could then move the eye by up to 2^-12 of the reach. In
// pictures of 1000 rows, this is about a third of a pixel.
#define COARSE          0x1p13
#define LARGEST_RATIO   0x1p40
#define LARGEST_RATE    0x1p60 // so that products with coordinates stay finite
#define LARGEST_PICTURE 0x1p20 // so that the other side of a picture stays below LARGEST_RATIO

static BoundingBox box_of(const Scene *scene)
{
    BoundingBox box = bounding_box_empty();
    for (size_t i = 0; i < scene->objects.count; i++)
        mesh_add_bounds(&scene->objects.data[i].mesh, &box);
    if (scene_triangle_count(scene) > 0)
        return box;
    for (size_t i = 0; i < scene->spheres.count; i++) {
        const Sphere *sphere = &scene->spheres.data[i];
        const Vec3 reach = {sphere->radius, sphere->radius, sphere->radius};
        bounding_box_add(&box, vec3_sub(sphere->center, reach));
        bounding_box_add(&box, vec3_add(sphere->center, reach));
    }
    return box;
}

// Returns the box's longest side, or a negative number if the box is empty.
static double extent_of(const BoundingBox *box)
{
    return box->low.x <= box->high.x ? vec3_extent(bounding_box_sides(box)) : -1;
}

double normalization_extent(const Scene *scene)
{
    const BoundingBox box = box_of(scene);
    return extent_of(&box);
}

// Returns the distance from a point to the nearest surface of a sphere.
static double distance_to_spheres(const Scene *scene, Vec3 point)
{
    double nearest = INFINITY;
    for (size_t i = 0; i < scene->spheres.count; i++) {
        const Sphere *sphere = &scene->spheres.data[i];
        const double distance = vec3_length(vec3_sub(point, sphere->center));
        nearest = fmin(nearest, fabs(distance - sphere->radius));
    }
    return nearest;
}

// Returns the distance from a point to the nearest bounding box of a triangle.
static double distance_to_triangles(const Scene *scene, Vec3 point)
{
    double nearest = INFINITY;
    for (size_t i = 0; i < scene->objects.count; i++) {
        const Mesh *mesh = &scene->objects.data[i].mesh;
        for (size_t triangle = 0; triangle < mesh->triangle_count; triangle++) {
            BoundingBox box = bounding_box_empty();
            for (int corner = 0; corner < 3; corner++)
                bounding_box_add(&box, mesh_corner(mesh, triangle, corner));
            const Vec3 inside = vec3_lower(vec3_upper(point, box.low), box.high);
            nearest = fmin(nearest, vec3_length(vec3_sub(point, inside)));
        }
    }
    return nearest;
}

// Returns the camera's reach: the distance to the look-at point or, if no surface is that near, to
// the nearest surface. The sizes of visible details are proportional to the reach. For an
// orthographic camera, returns the picture's height.
static double reach_of(const Scene *scene, const Viewpoint *viewpoint)
{
    if (viewpoint->height > 0)
        return viewpoint->height;
    return fmax(vec3_length(vec3_sub(viewpoint->look_at, viewpoint->eye)),
                fmin(distance_to_spheres(scene, viewpoint->eye),
                     distance_to_triangles(scene, viewpoint->eye)));
}

// Returns the center of the normalized coordinates of a scene without triangles. `center` is the
// center of the scene's box. Spheres store coordinates as sums of two floats, but eyes store them
// as single floats, so only eyes lose precision far from the center.
static Vec3 center_of(const Scene *scene, Vec3 center)
{
    const double extent = normalization_extent(scene);
    BoundingBox eyes = bounding_box_empty();
    double reach = INFINITY;
    for (size_t i = 0; i < scene->viewpoints.count; i++) {
        bounding_box_add(&eyes, scene->viewpoints.data[i].eye);
        reach = fmin(reach, reach_of(scene, &scene->viewpoints.data[i]));
    }
    if (!(extent > COARSE * reach) || extent < 4 * extent_of(&eyes))
        return center;
    const Vec3 between = bounding_box_center(&eyes);
    return vec3_extent(vec3_sub(between, center)) <= extent ? between : center;
}

Normalization normalization_of_primitives(const Scene *scene)
{
    const BoundingBox box = box_of(scene);
    const double extent = extent_of(&box);
    if (extent < 0)
        return (Normalization){{0, 0, 0}, 1};
    return (Normalization){bounding_box_center(&box), extent > 0 ? scalbn(1, -ilogb(extent)) : 1};
}

Normalization normalization_of(const Scene *scene)
{
    Normalization made = normalization_of_primitives(scene);
    if (scene_triangle_count(scene) == 0)
        made.center = center_of(scene, made.center);
    return made;
}

Vec3 normalize_point(const Normalization *normalization, Vec3 point)
{
    return vec3_scale(vec3_sub(point, normalization->center), normalization->scale);
}

Vec3 normalize_light(const Normalization *normalization, const Light *light)
{
    return light->is_sun ? vec3_scale(vec3_normalize(light->position), SUN_DISTANCE)
                         : normalize_point(normalization, light->position);
}

// A checker consists of cubes of two colors, so a shift by an even number of cubes changes nothing.
// remainder() subtracts the nearest such number from the shift, which stays precise far from the
// origin.
void normalize_checker(Material *material, const Normalization *normalization)
{
    const double size = (double)material->check_size;
    const Vec3 center = normalization->center;
    if (!(size > 0))
        return;
    const double rate = 1 / (size * normalization->scale);
    material->check_rate = (float)fmax(fmin(rate, LARGEST_RATE), 1 / LARGEST_RATE);
    vec3_store(material->check_shift,
               vec3(remainder(center.x / size, 2), remainder(center.y / size, 2),
                    remainder(center.z / size, 2)));
}

Vec3 denormalize_point(const Normalization *normalization, Vec3 point)
{
    return vec3_add(vec3_scale(point, 1 / normalization->scale), normalization->center);
}

static bool is_near(const Normalization *normalization, Vec3 point)
{
    return vec3_extent(normalize_point(normalization, point)) <= LARGEST_RATIO;
}

static bool viewpoint_fits(const Normalization *normalization, const Viewpoint *viewpoint)
{
    const double height = viewpoint->height * normalization->scale;
    const double width = viewpoint->width * normalization->scale;
    return height == 0 || (height >= 1 / LARGEST_RATIO && fmax(height, width) <= LARGEST_PICTURE);
}

static bool sphere_fits(const Normalization *normalization, const Sphere *sphere)
{
    const double radius = sphere->radius * normalization->scale;
    return is_near(normalization, sphere->center) && radius <= LARGEST_RATIO &&
           radius >= 1 / LARGEST_RATIO;
}

// Returns the distance between neighboring floats at `distance` from the center, in scene units.
static double step_at(const Normalization *normalization, double distance)
{
    return scalbn(1 / normalization->scale, ilogb(distance * normalization->scale) - 23);
}

bool normalization_is_fine(const Normalization *normalization, const Scene *scene, Error *note)
{
    for (size_t i = 0; i < scene->viewpoints.count; i++) {
        const Viewpoint *viewpoint = &scene->viewpoints.data[i];
        const double away = vec3_extent(vec3_sub(viewpoint->eye, normalization->center));
        // A distant look-at point suffices. Otherwise reach_of visits all triangles.
        if (viewpoint->height == 0 &&
            away <= COARSE / 2 * vec3_length(vec3_sub(viewpoint->look_at, viewpoint->eye)))
            continue;
        const double reach = reach_of(scene, viewpoint);
        if (away > COARSE / 2 * reach)
            return error_set(
                note,
                "view %zu shows objects %.3g away, but the coordinates of its eye are rounded to "
                "multiples of %.3g, because the scene's center is %.3g away: render distant parts "
                "separately",
                i + 1, reach, step_at(normalization, away), away);
    }
    return true;
}

bool normalization_check(const Normalization *normalization, const Scene *scene, Error *error)
{
    for (size_t i = 0; i < scene->lights.count; i++)
        if (!scene->lights.data[i].is_sun &&
            !is_near(normalization, scene->lights.data[i].position))
            return error_set(error, "light %zu is more than 5e11 times the scene's size away",
                             i + 1);
    for (size_t i = 0; i < scene->viewpoints.count; i++)
        if (!is_near(normalization, scene->viewpoints.data[i].eye))
            return error_set(error, "camera %zu is more than 5e11 times the scene's size away",
                             i + 1);
    for (size_t i = 0; i < scene->viewpoints.count; i++)
        if (!viewpoint_fits(normalization, &scene->viewpoints.data[i]))
            return error_set(error,
                             "the height of orthographic camera %zu is not between 1e-12 and 1e6 "
                             "times the scene's size",
                             i + 1);
    for (size_t i = 0; i < scene->spheres.count; i++)
        if (!sphere_fits(normalization, &scene->spheres.data[i]))
            return error_set(error,
                             "sphere %zu is more than 5e11 times the scene's size away, or its "
                             "radius is not within a factor of 1e12 of that size",
                             i + 1);
    return true;
}
