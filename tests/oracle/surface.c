// SPDX-License-Identifier: MIT
// `face` points toward the viewer. A triangle's `normal` is flipped together with `face`, whereas a
// sphere's `normal` always points outward.
#include "oracle/surface.h"

#include "scene/normalize.h"

// The largest error of a hit point, relative to its coordinates and distance. New rays ignore hits
// that are nearer than this error.
#define POINT_ERROR 1e-10

static Vec3 diffuse_of(const Scene *scene, uint32_t material)
{
    const float *diffuse = scene->materials.data[material].diffuse;
    return vec3((double)diffuse[0], (double)diffuse[1], (double)diffuse[2]);
}

// A surface counts as parallel to an axis if its unit normal's component on the axis is at most
// this in magnitude.
#define LEAN 0x1p-10

// The layers of cubes perpendicular to an axis. rate * coordinate + shift is the coordinate in
// cubes, and its integer part is the layer's index.
typedef struct {
    double rate, shift;
    double step; // 2^-19 of a cube plus 2^-19 of clrt's unit of normalized length, in cubes
} Layers;

static Layers layers_of(const Scene *scene, const Material *material, int axis)
{
    const double size = (double)material->check_size, rate = (double)material->check_rate;
    const double unit = 1 / (size * normalization_of(scene).scale);
    if (rate > 0) // the scene is normalized (stored.h)
        return (Layers){rate, (double)material->check_shift[axis], 0x1p-19 * (1 + rate)};
    return (Layers){1 / size, 0, 0x1p-19 * (1 + unit)};
}

// Returns the index of the layer that contains a coordinate on an axis. First moves the coordinate
// slightly behind the surface. If the surface is parallel to the axis, increases the coordinate
// slightly instead.
static double layer_at(Layers layers, double coordinate, double lean)
{
    const double place = layers.rate * coordinate + layers.shift;
    return floor(lean > LEAN ? place - layers.step : place + layers.step);
}

// If the material has a checker, colors the surface by its cube. `side` points away from the cube.
static void check(OracleSurface *surface, const Scene *scene, Vec3 side)
{
    const Material *material = &scene->materials.data[surface->material];
    if (!(material->check_size > 0))
        return;
    const double sum = layer_at(layers_of(scene, material, 0), surface->point.x, side.x) +
                       layer_at(layers_of(scene, material, 1), surface->point.y, side.y) +
                       layer_at(layers_of(scene, material, 2), surface->point.z, side.z);
    surface->odd = fmod(sum, 2) != 0;
    const float *color = material->checks[surface->odd ? 1 : 0];
    surface->body = vec3((double)color[0], (double)color[1], (double)color[2]);
}

static void sphere_surface(OracleSurface *surface, const Scene *scene)
{
    const Sphere *sphere = &scene->spheres.data[surface->id];
    surface->object = surface->id;
    surface->material = sphere->material;
    surface->body = diffuse_of(scene, sphere->material);
    surface->normal = vec3_normalize(vec3_sub(surface->point, sphere->center));
    surface->front = vec3_dot(surface->normal, surface->toward_viewer) >= 0;
    surface->face = vec3_scale(surface->normal, surface->front ? 1 : -1);
    check(surface, scene, surface->normal);
}

// Returns the weight of a corner: twice the area between the point and the opposite edge.
static double weight_of_corner(Vec3 point, Vec3 b, Vec3 c, Vec3 normal)
{
    const Vec3 area = vec3_cross(vec3_sub(b, point), vec3_sub(c, point));
    return vec3_dot(area, normal);
}

static Vec3 vertex_normal(const Mesh *mesh, uint32_t vertex, Vec3 face)
{
    const float *normal = mesh->normals[vertex];
    if (normal[0] == 0 && normal[1] == 0 && normal[2] == 0)
        return face;
    return vec3((double)normal[0], (double)normal[1], (double)normal[2]);
}

typedef struct {
    double of[3]; // the weights of the corners at the point; their sum is 1
} Shares;

// Returns the weights of the corners (weight_of_corner), divided by their sum.
static Shares shares_of(const Mesh *mesh, const uint32_t corners[3], Vec3 point, Vec3 face)
{
    Vec3 p[3];
    Shares shares;
    double sum = 0;
    for (int corner = 0; corner < 3; corner++) {
        const double *position = mesh->positions[corners[corner]];
        p[corner] = vec3(position[0], position[1], position[2]);
    }
    for (int corner = 0; corner < 3; corner++) {
        shares.of[corner] = weight_of_corner(point, p[(corner + 1) % 3], p[(corner + 2) % 3], face);
        sum += shares.of[corner];
    }
    for (int corner = 0; corner < 3; corner++)
        shares.of[corner] /= sum;
    return shares;
}

static Vec3 interpolated_normal(const Mesh *mesh, const uint32_t corners[3], const Shares *shares,
                                Vec3 face)
{
    Vec3 sum = {0, 0, 0};
    for (int corner = 0; corner < 3; corner++)
        sum = vec3_add(sum,
                       vec3_scale(vertex_normal(mesh, corners[corner], face), shares->of[corner]));
    return vec3_extent(sum) > 0 ? vec3_normalize(sum) : face;
}

static Vec3 mixed_color(const Mesh *mesh, const uint32_t corners[3], const Shares *shares)
{
    Vec3 mixed = {0, 0, 0};
    for (int corner = 0; corner < 3; corner++) {
        const float *color = mesh->colors[corners[corner]];
        mixed.x += shares->of[corner] * (double)color[0];
        mixed.y += shares->of[corner] * (double)color[1];
        mixed.z += shares->of[corner] * (double)color[2];
    }
    return mixed;
}

static Vec3 face_normal(const Mesh *mesh, const uint32_t corners[3])
{
    const double *a = mesh->positions[corners[0]];
    const double *b = mesh->positions[corners[1]];
    const double *c = mesh->positions[corners[2]];
    return vec3_normalize(vec3_cross(vec3(b[0] - a[0], b[1] - a[1], b[2] - a[2]),
                                     vec3(c[0] - a[0], c[1] - a[1], c[2] - a[2])));
}

static void triangle_surface(OracleSurface *surface, const Scene *scene)
{
    size_t number = surface->id - scene->spheres.count, object = 0;
    while (number >= scene->objects.data[object].mesh.triangle_count)
        number -= scene->objects.data[object++].mesh.triangle_count;
    const MeshObject *owner = &scene->objects.data[object];
    const uint32_t *corners = owner->mesh.triangles[number];
    surface->object = (uint32_t)(scene->spheres.count + object);
    surface->material = owner->material;
    surface->face = surface->normal = face_normal(&owner->mesh, corners);
    const Shares shares = shares_of(&owner->mesh, corners, surface->point, surface->face);
    if (owner->mesh.normals != NULL)
        surface->normal = interpolated_normal(&owner->mesh, corners, &shares, surface->face);
    surface->front = vec3_dot(surface->face, surface->toward_viewer) > 0;
    if (!surface->front) {
        surface->face = vec3_scale(surface->face, -1);
        surface->normal = vec3_scale(surface->normal, -1);
    }
    surface->body = diffuse_of(scene, owner->material);
    check(surface, scene, surface->face);
    if (owner->mesh.colors != NULL)
        surface->body = mixed_color(&owner->mesh, corners, &shares);
}

bool surface_blocks(const OracleSurface *surface, Vec3 toward_light)
{
    const double viewer_height = vec3_dot(surface->face, surface->toward_viewer);
    const double light_height = vec3_dot(surface->face, toward_light);
    return viewer_height * light_height <= 0;
}

OracleSurface surface_at(const Scene *scene, const OracleRay *ray, OracleHit hit)
{
    OracleSurface surface = {.id = hit.id, .toward_viewer = vec3_scale(ray->direction, -1)};
    surface.point = vec3_add(ray->origin, vec3_scale(ray->direction, hit.t));
    surface.near = POINT_ERROR * (hit.t + vec3_extent(surface.point));
    if (hit.id < scene->spheres.count)
        sphere_surface(&surface, scene);
    else
        triangle_surface(&surface, scene);
    return surface;
}
