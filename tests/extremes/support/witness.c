// SPDX-License-Identifier: MIT
// Plane and quadratic equations, as in any textbook; fp64 keeps their errors far below the margin.
#include "witness.h"

#include "base/vec.h"

#define MARGIN 1e-5

typedef struct {
    Vec3 origin, direction;
    double t;
    Witness witness;
} Probe;

static Vec3 vector_of(const float values[3])
{
    return vec3((double)values[0], (double)values[1], (double)values[2]);
}

// Takes the hit at t where it is the nearest so far; between two so near to each other that
// rounding may swap them nothing is clear.
static void take(Probe *probe, double t, uint32_t material)
{
    if (fabs(t - probe->t) < MARGIN)
        probe->witness.clear = false;
    if (t >= probe->t)
        return;
    probe->t = t;
    probe->witness.material = material;
}

static void meet_triangle(Probe *probe, const TriangleData *triangle)
{
    const Vec3 a = vec3_sub(vector_of(triangle->a), probe->origin);
    const Vec3 b = vec3_sub(vector_of(triangle->b), probe->origin);
    const Vec3 c = vec3_sub(vector_of(triangle->c), probe->origin);
    // Volumes spanned by the ray and each edge: all of one sign inside, negative from the front.
    const double u = vec3_dot(probe->direction, vec3_cross(c, b));
    const double v = vec3_dot(probe->direction, vec3_cross(a, c));
    const double w = vec3_dot(probe->direction, vec3_cross(b, a));
    const double sum = u + v + w;
    const double smallest = fmin(u, fmin(v, w)) / fabs(sum), largest = fmax(u, fmax(v, w));
    const bool inside = sum > 0 ? smallest >= 0 : largest <= 0;
    const double nearest_edge = fmin(fabs(u), fmin(fabs(v), fabs(w))) / fabs(sum);
    if (nearest_edge < MARGIN)
        probe->witness.clear = false;
    const bool front = (sum > 0) != ((triangle->material & TRIANGLE_REVERSED) != 0);
    if (!inside || (!front && !(triangle->material & TRIANGLE_TWO_SIDED)))
        return;
    const Vec3 normal = vec3_cross(vec3_sub(b, a), vec3_sub(c, a));
    const double t = vec3_dot(normal, a) / vec3_dot(normal, probe->direction);
    if (t > 0)
        take(probe, t, triangle->material & ~TRIANGLE_MARKS);
}

static void meet_sphere(Probe *probe, const SphereData *sphere)
{
    const Vec3 center = vec3_add(vector_of(sphere->center), vector_of(sphere->center_low));
    const double radius = (double)sphere->radius + (double)sphere->radius_low;
    const Vec3 from = vec3_sub(probe->origin, center);
    const double dd = vec3_dot(probe->direction, probe->direction);
    const double b = vec3_dot(from, probe->direction) / dd;
    const double c = (vec3_dot(from, from) - radius * radius) / dd;
    const double discriminant = b * b - c;
    if (fabs(discriminant) < MARGIN * radius * radius)
        probe->witness.clear = false;
    if (discriminant < 0)
        return;
    const double near = -b - sqrt(discriminant), far = -b + sqrt(discriminant);
    if (far > 0)
        take(probe, near > 0 ? near : far, sphere->material);
}

Witness witness_pixel(const FlatScene *flat, const CameraData *camera, uint32_t size, uint32_t x,
                      uint32_t y)
{
    const double across = 2.0 * x + 1 - size, down = 2.0 * y + 1 - size;
    Probe probe = {vector_of(camera->eye), vector_of(camera->forward), INFINITY, {NOTHING, true}};
    probe.direction =
        vec3_add(probe.direction, vec3_add(vec3_scale(vector_of(camera->right_step), across),
                                           vec3_scale(vector_of(camera->down_step), down)));
    for (uint32_t i = 0; i < flat->sphere_count; i++)
        meet_sphere(&probe, &flat->spheres[i]);
    for (uint32_t i = 0; i < flat->triangle_count; i++)
        meet_triangle(&probe, &flat->triangles[i]);
    return probe.witness;
}
