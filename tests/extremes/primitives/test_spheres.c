// SPDX-License-Identifier: MIT
// Compares hits on spheres with results in quadruple precision. The spheres are far away, huge,
// tiny, around the eye, or touched by tangent rays. All coordinates are normalized.
#include "oracle/quad.h"
#include "support/outcome.h"
#include "support/rays.h"
#include "support/shapes.h"

#define ERROR_LIMIT 3e-7 // the largest relative error of a distance

static SphereData sphere_of(Vec3 center, double radius)
{
    SphereData data = {.radius = (float)radius};
    shape_store(data.center, center);
    shape_store(data.center_low, vec3_sub(center, vec3_of_floats(data.center)));
    data.radius_low = (float)(radius - (double)data.radius);
    return data;
}

// Returns the distance to the sphere, or INFINITY if the ray misses it.
static double exact_distance(const SphereData *sphere, const TestRay *ray)
{
    Quad dd = 0, fd = 0, ff = 0;
    for (int axis = 0; axis < 3; axis++) {
        const Quad center = (Quad)sphere->center[axis] + sphere->center_low[axis];
        const Quad f = ray->origin[axis] - center, d = ray->direction[axis];
        dd += d * d;
        fd += f * d;
        ff += f * f;
    }
    const Quad radius = (Quad)sphere->radius + sphere->radius_low;
    const Quad c = ff - radius * radius, square = fd * fd - dd * c;
    if (square < 0)
        return INFINITY;
    const Quad root = quad_root(square);
    const Quad q = fd < 0 ? -fd + root : -fd - root;
    const Quad one = q / dd, other = q != 0 ? c / q : 0;
    const Quad near = one < other ? one : other, far = one < other ? other : one;
    if (!(far > 0))
        return INFINITY;
    return (double)(near > 0 ? near : far);
}

// Counts of rays with wrong hits, and the largest relative error of a distance.
typedef struct {
    size_t sides;   // rays that wrongly hit or wrongly miss
    size_t inexact; // distances with an error above ERROR_LIMIT
    size_t invalid; // no distance for a hit, or a distance for a miss
    double largest_error;
} Differences;

static Differences trace(RayBatch *batch, const SphereData *sphere, Rays rays)
{
    Differences found = {0};
    ray_batch_upload_sphere(batch, sphere);
    TestHit *hits = ray_batch_trace(batch, BATCH_NEAREST, rays);
    for (size_t i = 0; i < rays.count; i++) {
        const double exact = exact_distance(sphere, &rays.data[i]);
        const bool met = hits[i].id != NOTHING;
        found.sides += met != (exact < INFINITY);
        found.invalid += !(hits[i].t > 0) || met != (hits[i].t < INFINITY);
        if (!met || !(exact < INFINITY))
            continue;
        const double error = fabs((double)hits[i].t - exact) / exact;
        found.inexact += !(error <= ERROR_LIMIT);
        found.largest_error = fmax(found.largest_error, error);
    }
    free(hits);
    return found;
}

// Aims from around the origin at points within 1.2 radii of the center.
static void aim_around(Rays rays, Vec3 center, double radius, Random *random)
{
    Vec3 origin = {0};
    for (size_t i = 0; i < rays.count; i++) {
        if (rays_move_origin(i, 64))
            origin = random_in_cube(random, 1);
        Vec3 apart = random_in_cube(random, 1.2);
        while (vec3_dot(apart, apart) > 1.2 * 1.2)
            apart = random_in_cube(random, 1.2);
        rays.data[i] = ray_between(origin, vec3_add(center, vec3_scale(apart, radius)));
    }
}

static Vec3 at_distance(double distance)
{
    return vec3_scale(vec3_normalize(vec3(3, -2, 1.5)), distance);
}

EXTREME(a_sphere_smaller_than_the_rounding_of_its_center_gives_no_invalid_hit_t31)
{
    Random random = {31};
    FREED_BY(rays_free) const Rays rays = rays_make(tier_size(10000, 1000000));
    const SphereData sphere = sphere_of(at_distance(1e6), 1e-6);
    aim_around(rays, at_distance(1e6), 1e-6, &random);
    const Differences found = trace(*state, &sphere, rays);
    outcome_report(outcome_of("T-31", rays.count, found.invalid), "false_hits=%zu", found.sides);
}

EXTREME(far_spheres_are_hit_and_missed_exactly_t32)
{
    Random random = {32};
    FREED_BY(rays_free) const Rays rays = rays_make(tier_size(10000, 300000));
    for (double distance = 10; distance < 2e6; distance *= 10) {
        const SphereData sphere = sphere_of(at_distance(distance), 1);
        aim_around(rays, at_distance(distance), 1, &random);
        const Differences found = trace(*state, &sphere, rays);
        outcome_report(outcome_of("T-32", rays.count, found.sides), "distance=%g sides", distance);
        outcome_report(outcome_of("T-32", rays.count, found.inexact + found.invalid),
                       "distance=%g largest_error=%.2g", distance, found.largest_error);
    }
}

// Traces the rays, and reports all differences.
static void judge_radius(const char *test, RayBatch *batch, const SphereData *sphere, Rays rays)
{
    const Differences found = trace(batch, sphere, rays);
    outcome_report(outcome_of(test, rays.count, found.inexact + found.invalid + found.sides),
                   "radius=%g largest_error=%.2g", (double)sphere->radius, found.largest_error);
}

// Rays start 1 above the top of the sphere and go down.
EXTREME(the_ground_may_be_a_sphere_of_any_radius_t33)
{
    Random random = {33};
    Vec3 origin = {0};
    FREED_BY(rays_free) const Rays rays = rays_make(tier_size(10000, 300000));
    for (double radius = 1e3; radius < 2e9; radius *= 10) {
        const SphereData sphere = sphere_of(vec3(0, 0, -radius), radius);
        for (size_t i = 0; i < rays.count; i++) {
            if (rays_move_origin(i, 64)) {
                origin = random_in_cube(&random, 1);
                origin.z = 1;
            }
            Vec3 direction = random_in_cube(&random, 1);
            direction.z = -fabs(direction.z) - 0.01;
            rays.data[i] = ray_between(origin, vec3_add(origin, direction));
        }
        judge_radius("T-33", *state, &sphere, rays);
    }
}

EXTREME(an_eye_inside_a_sphere_sees_its_far_wall_t34)
{
    static const double radii[] = {1, 1e6};
    Random random = {34};
    Vec3 origin = {0};
    FREED_BY(rays_free) const Rays rays = rays_make(tier_size(10000, 300000));
    for (int i = 0; i < 2; i++) {
        const SphereData sphere = sphere_of(vec3(0.1 * radii[i], 0, -0.3 * radii[i]), radii[i]);
        for (size_t ray = 0; ray < rays.count; ray++) {
            if (rays_move_origin(ray, 64))
                origin = random_in_cube(&random, 0.35 * radii[i]);
            rays.data[ray] = ray_between(origin, vec3_add(origin, random_in_cube(&random, 1)));
        }
        judge_radius("T-34", *state, &sphere, rays);
    }
}

// Pythagorean triples: (a, b) is on the circle of radius c around the origin.
static const int triples[][3] = {{3, 4, 5},    {5, 12, 13},  {8, 15, 17},     {7, 24, 25},
                                 {20, 21, 29}, {9, 40, 41},  {12, 35, 37},    {28, 45, 53},
                                 {16, 63, 65}, {33, 56, 65}, {119, 120, 169}, {696, 697, 985}};
#define TANGENTS 64 // rays per triple

// Returns a ray along the tangent at (a, b), moved outward by apart * 2^-20 radii. If apart is 0,
// the ray is level and touches the sphere. Other rays may slope.
static TestRay tangent(const int *triple, int apart, Random *random)
{
    const double a = triple[0], b = triple[1], outward = 1 + apart * 0x1p-20;
    const double steps = 1 + random_below(random, 7), slope = (int)random_below(random, 9) - 4;
    const double height = apart == 0 ? 0 : slope;
    const TestRay ray = {.origin = {(float)(a * outward + steps * b),
                                    (float)(b * outward - steps * a), (float)height},
                         .own = NOTHING,
                         .direction = {(float)-b, (float)a, (float)-height / (float)(8 * steps)},
                         .kind = RAY_CAMERA};
    return ray;
}

EXTREME(rays_along_a_tangent_are_met_by_the_exact_sign_t35)
{
    for (int apart = -2; apart <= 2; apart++) {
        size_t sides = 0;
        Random random = {35};
        for (size_t triple = 0; triple < COUNT(triples); triple++) {
            TestRay rays[TANGENTS];
            const SphereData sphere = sphere_of(vec3(0, 0, 0), triples[triple][2]);
            for (int i = 0; i < TANGENTS; i++)
                rays[i] = tangent(triples[triple], apart, &random);
            sides += trace(*state, &sphere, (Rays){rays, TANGENTS}).sides;
        }
        outcome_report(outcome_of("T-35", COUNT(triples) * TANGENTS, sides), "apart=%d", apart);
    }
}

FIXTURES(ray_batch_setup, ray_batch_teardown)
