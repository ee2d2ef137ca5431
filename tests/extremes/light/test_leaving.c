// SPDX-License-Identifier: MIT
// A ray that leaves a convex surface outward must hit nothing. It must not hit its own triangle or
// sphere, a twin in the same place, or a neighbor. Sizes, places and angles vary.
#include "support/outcome.h"
#include "support/rays.h"
#include "support/shapes.h"

typedef struct {
    Rays rays;
    float (*outward)[3]; // unit vectors, by ray
} Leaving;

static Leaving leaving_make(size_t count)
{
    return (Leaving){rays_make(count), require_memory(count, sizeof(float[3]))};
}

static void leaving_free(Leaving *leaving)
{
    free(leaving->rays.data);
    free(leaving->outward);
}

// Chooses a ray's direction. Every fourth ray leaves the face at a low angle. The angle's sine is
// at least about 2^-lowest.
static void choose_outward(Leaving *leaving, size_t ray, Vec3 normal, uint32_t lowest,
                           Random *random)
{
    Vec3 direction = random_direction(random);
    if (ray % 4 == 0) {
        const double height =
            scalbn(random_between(random, 0.5, 1), -(int)random_below(random, lowest));
        const Vec3 along = vec3_sub(direction, vec3_scale(normal, vec3_dot(normal, direction)));
        direction = vec3_normalize(vec3_add(along, vec3_scale(normal, height)));
    }
    shape_store(leaving->outward[ray], direction);
}

// Each ray that left a surface counts as two tries: a reflected ray and a shadow ray. The ray fails
// if either try hits something.
static Outcome judge_leaving(const char *test, RayBatch *batch, const Leaving *leaving)
{
    Outcome outcome = {.test = test};
    TestHit *hits = ray_batch_leave(batch, leaving->rays, (const float(*)[3])leaving->outward);
    for (size_t i = 0; i < leaving->rays.count; i++) {
        outcome.count += hits[i].t > 0 || hits[i].id != NOTHING ? 2 : 0;
        outcome.failures[BY_CLRT] += hits[i].id != NOTHING;
    }
    free(hits);
    return outcome;
}

// Reports the sum. Ends the test if fewer than `least` rays have left a surface.
static void report_leaving(Outcome sum, const char *shape, size_t least)
{
    outcome_report(sum, "shape=%s", shape);
    assert_true(sum.count / 2 >= least);
}

// Returns a coordinate of either sign whose size is between 1e-8 and 1e8.
static double any_coordinate(Random *random)
{
    const double size = pow(10, random_between(random, -8, 8));
    return random_below(random, 2) == 0 ? size : -size;
}

static Vec3 any_point(Random *random)
{
    const double x = any_coordinate(random), y = any_coordinate(random);
    return vec3(x, y, any_coordinate(random));
}

// Returns a triangle and its twin with the opposite orientation.
static Scene triangle_and_twin(Random *random)
{
    const Vec3 a = any_point(random), b = any_point(random), c = any_point(random);
    Scene scene = shape_scene(shape_triangle(a, b, c));
    shape_add(&scene, shape_triangle(a, c, b), 1);
    return scene;
}

EXTREME(a_ray_that_leaves_a_triangle_never_meets_it_again_t37)
{
    Random random = {37};
    Outcome sum = {0};
    Vec3 origin = {0};
    const size_t triangles = tier_size(100, 1000);
    Leaving leaving = leaving_make(tier_size(200, 1000));
    for (size_t i = 0; i < triangles; i++) {
        Stage stage;
        FREED_BY(scene_free) Scene scene = triangle_and_twin(&random);
        stage_make(&stage, &scene, TREE_SAH);
        const Vec3 normal = normal_of(&stage.triangles, 0);
        for (size_t ray = 0; ray < leaving.rays.count; ray++) {
            const double u = random_between(&random, 0, 1), v = random_between(&random, 0, 1 - u);
            if (rays_move_origin(ray, 64))
                origin = random_in_cube(&random, 2);
            leaving.rays.data[ray] = ray_between(origin, point_of(&stage.triangles, 0, u, v));
            choose_outward(&leaving, ray, normal, 24, &random);
        }
        ray_batch_upload(*state, &stage.flat);
        outcome_add(&sum, judge_leaving("T-37", *state, &leaving));
        stage_free(&stage);
    }
    report_leaving(sum, "triangles", triangles * leaving.rays.count / 4);
    leaving_free(&leaving);
}

// Aims at the triangles from outside. Rounding can move a ray's start slightly below its face. A
// very low ray near the shape's edge would then hit the next face, so the test avoids such rays.
static void aim_at_shape(Leaving *leaving, const Triangles *triangles, Random *random)
{
    Vec3 origin = {0};
    for (size_t i = 0; i < leaving->rays.count; i++) {
        const uint32_t triangle = random_below(random, (uint32_t)triangles->count);
        const double u = random_between(random, 0.01, 0.9);
        const double v = i % 2 == 0 ? 0x1p-6 : random_between(random, 0.01, 0.99 - u);
        if (rays_move_origin(i, RAY_BUNDLE))
            origin = vec3_scale(random_direction(random), 4);
        leaving->rays.data[i] = ray_between(origin, point_of(triangles, triangle, u, v));
        choose_outward(leaving, i, normal_of(triangles, triangle), 10, random);
    }
}

static void judge_shape(RayBatch *batch, const char *name, Mesh mesh)
{
    Stage stage;
    Random random = {3737};
    FREED_BY(scene_free) Scene scene = shape_scene(mesh);
    Leaving leaving = leaving_make(tier_size(10000, 500000));
    stage_make(&stage, &scene, TREE_SAH);
    ray_batch_upload(batch, &stage.flat);
    aim_at_shape(&leaving, &stage.triangles, &random);
    report_leaving(judge_leaving("T-37", batch, &leaving), name, leaving.rays.count / 2);
    leaving_free(&leaving);
    stage_free(&stage);
}

EXTREME(a_ray_that_leaves_a_convex_shape_never_meets_a_neighbor_t37)
{
    judge_shape(*state, "cube", shape_cube(1, 9));
    judge_shape(*state, "plane", shape_plane(vec3(5, 7, 9), vec3(8, 0, 0), vec3(0, 8, 0), 64));
    judge_shape(*state, "quad",
                shape_plane(vec3(1000, 0, 0), vec3(4, 1, 0.5), vec3(-1, 4, 0.25), 1));
}

// Spheres have radii from 1e-4 to 1e4. Their centers are up to 1e5 radii from the origin.
EXTREME(a_ray_that_leaves_a_sphere_never_meets_it_again_t38)
{
    Random random = {38};
    Outcome sum = {0};
    Vec3 origin = {0};
    const size_t spheres = tier_size(100, 1000);
    Leaving leaving = leaving_make(tier_size(200, 1000));
    for (size_t i = 0; i < spheres; i++) {
        const double radius = pow(10, random_between(&random, -4, 4));
        const double away = radius * pow(10, random_between(&random, 0, 5));
        const Vec3 center = vec3_scale(random_direction(&random), away);
        SphereData sphere = {.radius = (float)radius};
        shape_store(sphere.center, center);
        for (size_t ray = 0; ray < leaving.rays.count; ray++) {
            const Vec3 from = random_direction(&random), to = random_direction(&random);
            if (rays_move_origin(ray, 64))
                origin = vec3_add(center, vec3_scale(from, random_between(&random, 2, 9) * radius));
            leaving.rays.data[ray] = ray_between(origin, vec3_add(center, vec3_scale(to, radius)));
            choose_outward(&leaving, ray, to, 24, &random);
        }
        ray_batch_upload_sphere(*state, &sphere);
        outcome_add(&sum, judge_leaving("T-38", *state, &leaving));
    }
    report_leaving(sum, "spheres", spheres * leaving.rays.count / 4);
    leaving_free(&leaving);
}

FIXTURES(ray_batch_setup, ray_batch_teardown)
