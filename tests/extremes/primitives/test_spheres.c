// SPDX-License-Identifier: MIT
// Spheres far away, huge, tiny, around the eye and touched by rays, in quadruple precision's light.
// They lie in the frame as they are given: nothing is normalized.
#include "support/aim.h"
#include "support/check.h"
#include "support/report.h"
#include "support/tier.h"

#include <math.h>
#include <stdlib.h>

__extension__ typedef __float128 Quad;

#define ERROR_LIMIT 3e-7 // of distances, relative

static SphereData sphere_of(Vec3 center, double radius)
{
    const double values[4] = {center.x, center.y, center.z, radius};
    float high[4], low[4];
    SphereData data = {0};
    for (int i = 0; i < 4; i++) {
        high[i] = (float)values[i];
        low[i] = (float)(values[i] - (double)high[i]);
    }
    for (int axis = 0; axis < 3; axis++) {
        data.center[axis] = high[axis];
        data.center_low[axis] = low[axis];
    }
    data.radius = high[3];
    data.radius_low = low[3];
    return data;
}

static Quad root_of(Quad square)
{
    Quad root = sqrtl((long double)square);
    for (int step = 0; step < 2 && root > 0; step++)
        root = (root + square / root) / 2;
    return root;
}

typedef struct {
    bool met;
    double t;
} Exact;

static Exact exact_distance(const SphereData *sphere, const TestRay *ray)
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
        return (Exact){false, INFINITY};
    const Quad root = root_of(square);
    const Quad q = fd < 0 ? -fd + root : -fd - root;
    const Quad one = q / dd, other = q != 0 ? c / q : 0;
    const Quad near = one < other ? one : other, far = one < other ? other : one;
    if (!(far > 0))
        return (Exact){false, INFINITY};
    return (Exact){true, (double)(near > 0 ? near : far)};
}

// How the device's answers differ from the exact ones.
typedef struct {
    size_t sides, inexact, invalid; // hit for miss or miss for hit; distances; no distances at all
    double largest_error;
} Differences;

static Differences differences_of(const SphereData *sphere, const TestRay *rays,
                                  const TestHit *hits, size_t count)
{
    Differences differences = {0};
    for (size_t i = 0; i < count; i++) {
        const Exact exact = exact_distance(sphere, &rays[i]);
        const bool met = hits[i].id != NOTHING;
        differences.sides += met != exact.met;
        differences.invalid += !(hits[i].t > 0) || met != (hits[i].t < INFINITY);
        if (!met || !exact.met)
            continue;
        const double error = fabs((double)hits[i].t - exact.t) / exact.t;
        differences.inexact += !(error <= ERROR_LIMIT);
        differences.largest_error = fmax(differences.largest_error, error);
    }
    return differences;
}

static Differences trace(RayBatch *batch, const SphereData *sphere, const TestRay *rays,
                         size_t count)
{
    Error error = {0};
    SphereData data = *sphere;
    const FlatScene flat = {.layout = batch->choice.nodes, .spheres = &data, .sphere_count = 1};
    TestHit *hits = memory_raw(count, sizeof *hits, &error);
    require(hits != NULL, &error);
    ray_batch_upload(batch, &flat);
    ray_batch_trace(batch, BATCH_NEAREST, rays, count, hits);
    const Differences differences = differences_of(sphere, rays, hits, count);
    free(hits);
    return differences;
}

// From around the origin at points within 1.2 radii of the center.
static void aim_around(TestRay *rays, size_t count, Vec3 center, double radius, Random *random)
{
    Vec3 origin = {0};
    for (size_t i = 0; i < count; i++) {
        if (aim_moves_origin(i, 64))
            origin = random_in_cube(random, 1);
        Vec3 apart = random_in_cube(random, 1.2);
        while (vec3_dot(apart, apart) > 1.2 * 1.2)
            apart = random_in_cube(random, 1.2);
        rays[i] = aim_at(origin, vec3_add(center, vec3_scale(apart, radius)));
    }
}

static Vec3 at_distance(double distance)
{
    return vec3_scale(vec3_normalize(vec3(3, -2, 1.5)), distance);
}

static void a_sphere_smaller_than_its_places_bits_gives_no_invalid_hit_t31(void **state)
{
    char details[64];
    Random random = {31};
    const size_t count = tier_size(10000, 1000000);
    TestRay *rays = aim_make_rays(count);
    const SphereData sphere = sphere_of(at_distance(1e6), 1e-6);
    aim_around(rays, count, at_distance(1e6), 1e-6, &random);
    const Differences found = trace(*state, &sphere, rays, count);
    snprintf(details, sizeof details, "false_hits=%zu", found.sides);
    const size_t past = report_case("T-31", details, count, found.invalid);
    free(rays);
    assert_int_equal(past, 0);
}

// How many rays may be wrong at a distance; past 1e5 the rays' own directions are too coarse.
static size_t limit_at(double distance, size_t count)
{
    return distance < 0.9e5 ? 0 : distance < 0.9e6 ? (size_t)(2e-5 * (double)count) : count;
}

static void far_spheres_are_met_and_missed_as_exactly_t32(void **state)
{
    size_t past = 0;
    Random random = {32};
    const size_t count = tier_size(10000, 300000);
    TestRay *rays = aim_make_rays(count);
    for (double distance = 10; distance < 2e6; distance *= 10) {
        char details[96];
        const SphereData sphere = sphere_of(at_distance(distance), 1);
        aim_around(rays, count, at_distance(distance), 1, &random);
        const Differences found = trace(*state, &sphere, rays, count);
        snprintf(details, sizeof details, "distance=%g sides", distance);
        past +=
            report(&(Case){"T-32", details, count, found.sides, limit_at(distance, count), {0}});
        snprintf(details, sizeof details, "distance=%g largest_error=%.2g", distance,
                 found.largest_error);
        past += report_case("T-32", details, count, found.inexact + found.invalid);
    }
    free(rays);
    assert_int_equal(past, 0);
}

// Downward from a height of 1 over the top of the sphere.
static void aim_down(TestRay *rays, size_t count, Random *random)
{
    Vec3 origin = {0};
    for (size_t i = 0; i < count; i++) {
        if (aim_moves_origin(i, 64))
            origin = vec3(random_between(random, -1, 1), random_between(random, -1, 1), 1);
        Vec3 direction = random_in_cube(random, 1);
        direction.z = -fabs(direction.z) - 0.01;
        rays[i] = aim_at(origin, vec3_add(origin, direction));
    }
}

static void the_ground_may_be_a_sphere_of_any_radius_t33(void **state)
{
    size_t past = 0;
    Random random = {33};
    const size_t count = tier_size(10000, 300000);
    TestRay *rays = aim_make_rays(count);
    for (double radius = 1e3; radius < 2e9; radius *= 10) {
        char details[96];
        const SphereData sphere = sphere_of(vec3(0, 0, -radius), radius);
        aim_down(rays, count, &random);
        const Differences found = trace(*state, &sphere, rays, count);
        snprintf(details, sizeof details, "radius=%g largest_error=%.2g", radius,
                 found.largest_error);
        past += report_case("T-33", details, count, found.inexact + found.invalid + found.sides);
    }
    free(rays);
    assert_int_equal(past, 0);
}

static void an_eye_inside_a_sphere_sees_its_far_wall_t34(void **state)
{
    static const double radii[] = {1, 1e6};
    size_t past = 0;
    Random random = {34};
    const size_t count = tier_size(10000, 300000);
    TestRay *rays = aim_make_rays(count);
    for (int i = 0; i < 2; i++) {
        char details[96];
        Vec3 origin = {0};
        const SphereData sphere = sphere_of(vec3(0.1 * radii[i], 0, -0.3 * radii[i]), radii[i]);
        for (size_t ray = 0; ray < count; ray++) {
            if (aim_moves_origin(ray, 64))
                origin = random_in_cube(&random, 0.35 * radii[i]);
            rays[ray] = aim_at(origin, vec3_add(origin, random_in_cube(&random, 1)));
        }
        const Differences found = trace(*state, &sphere, rays, count);
        snprintf(details, sizeof details, "radius=%g largest_error=%.2g", radii[i],
                 found.largest_error);
        past += report_case("T-34", details, count, found.inexact + found.invalid + found.sides);
    }
    free(rays);
    assert_int_equal(past, 0);
}

// Pythagorean triples: (a, b) lies on the circle of radius c around the origin.
static const int triples[][3] = {{3, 4, 5},    {5, 12, 13},  {8, 15, 17},     {7, 24, 25},
                                 {20, 21, 29}, {9, 40, 41},  {12, 35, 37},    {28, 45, 53},
                                 {16, 63, 65}, {33, 56, 65}, {119, 120, 169}, {696, 697, 985}};
#define TRIPLES  (sizeof triples / sizeof *triples)
#define TANGENTS 64 // a triple's rays of each kind

// Along the tangent at (a, b), `apart` 2^-20ths of the radius outside of it.
static TestRay tangent(const int *triple, int apart, Random *random)
{
    const double a = triple[0], b = triple[1];
    const double steps = 1 + random_below(random, 7), height = (int)random_below(random, 9) - 4;
    const double outward = 1 + apart * 0x1p-20;
    TestRay ray = {.own = NOTHING, .kind = RAY_CAMERA};
    ray.origin[0] = (float)(a * outward + steps * b);
    ray.origin[1] = (float)(b * outward - steps * a);
    ray.origin[2] = (float)height;
    ray.direction[0] = (float)-b;
    ray.direction[1] = (float)a;
    ray.direction[2] = (float)-height / (float)(8 * steps);
    return ray;
}

// apart 0 touches the sphere only where the ray stays level.
static void rays_along_a_tangent_are_met_by_the_exact_sign_t35(void **state)
{
    size_t past = 0;
    for (int apart = -2; apart <= 2; apart++) {
        char details[64];
        size_t sides = 0;
        Random random = {35};
        for (size_t triple = 0; triple < TRIPLES; triple++) {
            TestRay rays[TANGENTS];
            const SphereData sphere = sphere_of(vec3(0, 0, 0), triples[triple][2]);
            for (int i = 0; i < TANGENTS; i++) {
                rays[i] = tangent(triples[triple], apart, &random);
                if (apart == 0)
                    rays[i].origin[2] = rays[i].direction[2] = 0;
            }
            sides += trace(*state, &sphere, rays, TANGENTS).sides;
        }
        snprintf(details, sizeof details, "apart=%d", apart);
        past += report_case("T-35", details, TRIPLES * TANGENTS, sides);
    }
    assert_int_equal(past, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sphere_smaller_than_its_places_bits_gives_no_invalid_hit_t31),
        cmocka_unit_test(far_spheres_are_met_and_missed_as_exactly_t32),
        cmocka_unit_test(the_ground_may_be_a_sphere_of_any_radius_t33),
        cmocka_unit_test(an_eye_inside_a_sphere_sees_its_far_wall_t34),
        cmocka_unit_test(rays_along_a_tangent_are_met_by_the_exact_sign_t35),
    };
    return cmocka_run_group_tests(tests, ray_batch_setup, ray_batch_teardown);
}
