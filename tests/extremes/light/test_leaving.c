// SPDX-License-Identifier: MIT
// A ray that leaves a convex surface outward meets nothing again, at whatever size, place and
// angle: neither the triangle or sphere itself, nor its twin in the same place, nor a neighbor.
#include "support/aim.h"
#include "support/check.h"
#include "support/report.h"
#include "support/shapes.h"
#include "support/tier.h"

#include <stdlib.h>

typedef struct {
    TestRay *rays;
    float (*outward)[3];
    TestHit *hits;
    size_t count;
} Leaving;

static Leaving leaving_make(size_t count)
{
    Error error = {0};
    const Leaving leaving = {aim_make_rays(count), memory_raw(count, sizeof(float[3]), &error),
                             memory_raw(count, sizeof(TestHit), &error), count};
    require(leaving.outward != NULL && leaving.hits != NULL, &error);
    return leaving;
}

static void leaving_free(Leaving *leaving)
{
    free(leaving->rays);
    free(leaving->outward);
    free(leaving->hits);
}

// Chooses a unit vector. Every fourth leaves the face with this normal at a sine down to 2^-lowest.
static void choose_outward(Leaving *leaving, size_t place, Vec3 normal, uint32_t lowest,
                           Random *random)
{
    Vec3 direction = vec3_normalize(random_in_cube(random, 1));
    if (place % 4 == 0) {
        const double height =
            scalbn(random_between(random, 0.5, 1), -(int)random_below(random, lowest));
        const Vec3 along = vec3_sub(direction, vec3_scale(normal, vec3_dot(normal, direction)));
        direction = vec3_normalize(vec3_add(along, vec3_scale(normal, height)));
    }
    leaving->outward[place][0] = (float)direction.x;
    leaving->outward[place][1] = (float)direction.y;
    leaving->outward[place][2] = (float)direction.z;
}

// Adds the rays that left a surface to *left.
static size_t count_returns(RayBatch *batch, const Leaving *leaving, size_t *left)
{
    size_t returns = 0;
    ray_batch_leave(batch, leaving->rays, (const float(*)[3])leaving->outward, leaving->count,
                    leaving->hits);
    for (size_t i = 0; i < leaving->count; i++) {
        *left += leaving->hits[i].t > 0 || leaving->hits[i].id != NOTHING;
        returns += leaving->hits[i].id != NOTHING;
    }
    return returns;
}

// A coordinate between 1e-8 and 1e8, of either sign.
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

// The triangle, and its twin that turns the other way.
static Scene triangle_and_twin(Random *random)
{
    const Vec3 a = any_point(random), b = any_point(random), c = any_point(random);
    Scene scene = shape_scene(shape_triangle(a, b, c));
    shape_add(&scene, shape_triangle(a, c, b), 1);
    return scene;
}

static void aim_at_triangle(Leaving *leaving, const Triangles *triangles, Random *random)
{
    Vec3 origin = {0};
    const Vec3 a = aim_corner(triangles, 0, 0);
    const Vec3 ab = vec3_sub(aim_corner(triangles, 0, 1), a);
    const Vec3 ac = vec3_sub(aim_corner(triangles, 0, 2), a);
    const Vec3 normal = vec3_normalize(vec3_cross(ab, ac));
    for (size_t i = 0; i < leaving->count; i++) {
        const double u = random_between(random, 0, 1), v = random_between(random, 0, 1 - u);
        if (aim_moves_origin(i, 64))
            origin = random_in_cube(random, 2);
        leaving->rays[i] =
            aim_at(origin, vec3_add(a, vec3_add(vec3_scale(ab, u), vec3_scale(ac, v))));
        choose_outward(leaving, i, normal, 24, random);
    }
}

static void a_ray_that_leaves_a_triangle_never_meets_it_again_t37(void **state)
{
    Random random = {37};
    size_t returns = 0, left = 0;
    const size_t triangles = tier_size(100, 1000);
    Leaving leaving = leaving_make(tier_size(200, 1000));
    for (size_t i = 0; i < triangles; i++) {
        Stage stage;
        Scene scene = triangle_and_twin(&random);
        stage_make(&stage, &scene, TREE_SAH);
        aim_at_triangle(&leaving, &stage.triangles, &random);
        ray_batch_upload(*state, &stage.flat);
        returns += count_returns(*state, &leaving, &left);
        stage_free(&stage);
        scene_free(&scene);
    }
    assert_in_range(left, triangles * leaving.count / 4, triangles * leaving.count);
    leaving_free(&leaving);
    report_case("T-37", "shape=triangles", 2 * left, returns);
    assert_int_equal(returns, 0);
}

// At its triangles from outside.  Points are rounded to a little below their face, so a ray so low
// and so near to the shape's edge that it has not risen by that until there meets the next face
// from inside: neither is tried.
static void aim_at_shape(Leaving *leaving, const Stage *stage, Random *random)
{
    Vec3 origin = {0};
    for (size_t i = 0; i < leaving->count; i++) {
        const uint32_t number = random_below(random, (uint32_t)stage->triangles.count);
        const Vec3 a = aim_corner(&stage->triangles, number, 0);
        const Vec3 ab = vec3_sub(aim_corner(&stage->triangles, number, 1), a);
        const Vec3 ac = vec3_sub(aim_corner(&stage->triangles, number, 2), a);
        const double u = random_between(random, 0.01, 0.9);
        const double v = i % 2 == 0 ? 0x1p-6 : random_between(random, 0.01, 0.99 - u);
        if (aim_moves_origin(i, AIM_BUNDLE))
            origin = vec3_scale(vec3_normalize(random_in_cube(random, 1)), 4);
        leaving->rays[i] =
            aim_at(origin, vec3_add(a, vec3_add(vec3_scale(ab, u), vec3_scale(ac, v))));
        choose_outward(leaving, i, vec3_normalize(vec3_cross(ab, ac)), 10, random);
    }
}

static size_t returns_to(RayBatch *batch, const char *name, Mesh mesh)
{
    Stage stage;
    char details[64];
    Random random = {3737};
    size_t left = 0;
    Scene scene = shape_scene(mesh);
    Leaving leaving = leaving_make(tier_size(10000, 500000));
    stage_make(&stage, &scene, TREE_SAH);
    ray_batch_upload(batch, &stage.flat);
    aim_at_shape(&leaving, &stage, &random);
    const size_t returns = count_returns(batch, &leaving, &left);
    snprintf(details, sizeof details, "shape=%s", name);
    assert_in_range(left, leaving.count / 2, leaving.count);
    leaving_free(&leaving);
    stage_free(&stage);
    scene_free(&scene);
    return report_case("T-37", details, 2 * left, returns);
}

static void a_ray_that_leaves_a_convex_shape_never_meets_a_neighbor_t37(void **state)
{
    size_t returns = returns_to(*state, "cube", shape_cube(1, 9));
    const Vec3 across = {4, 1, 0.5}, down = {-1, 4, 0.25};
    returns +=
        returns_to(*state, "plane", shape_plane(vec3(5, 7, 9), vec3(8, 0, 0), vec3(0, 8, 0), 64));
    returns += returns_to(*state, "quad", shape_plane(vec3(1000, 0, 0), across, down, 1));
    assert_int_equal(returns, 0);
}

// Offsets to 1e5 radii, radii from 1e-4 to 1e4.
static void a_ray_that_leaves_a_sphere_never_meets_it_again_t38(void **state)
{
    Random random = {38};
    RayBatch *batch = *state;
    size_t returns = 0, left = 0;
    const size_t spheres = tier_size(100, 1000);
    Leaving leaving = leaving_make(tier_size(200, 1000));
    for (size_t i = 0; i < spheres; i++) {
        const double radius = pow(10, random_between(&random, -4, 4));
        const double away = radius * pow(10, random_between(&random, 0, 5));
        const Vec3 center = vec3_scale(vec3_normalize(random_in_cube(&random, 1)), away);
        SphereData sphere = {.center = {(float)center.x, (float)center.y, (float)center.z},
                             .radius = (float)radius};
        Vec3 origin = {0};
        for (size_t ray = 0; ray < leaving.count; ray++) {
            const Vec3 side = vec3_normalize(random_in_cube(&random, 1));
            if (aim_moves_origin(ray, 64))
                origin = vec3_add(center, vec3_scale(side, random_between(&random, 2, 9) * radius));
            const Vec3 target =
                vec3_add(center, vec3_scale(vec3_normalize(random_in_cube(&random, 1)), radius));
            leaving.rays[ray] = aim_at(origin, target);
            choose_outward(&leaving, ray, vec3_normalize(vec3_sub(target, center)), 24, &random);
        }
        ray_batch_upload(
            batch,
            &(FlatScene){.layout = batch->choice.nodes, .spheres = &sphere, .sphere_count = 1});
        returns += count_returns(batch, &leaving, &left);
    }
    assert_in_range(left, spheres * leaving.count / 4, spheres * leaving.count);
    leaving_free(&leaving);
    report_case("T-38", "shape=spheres", 2 * left, returns);
    assert_int_equal(returns, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_ray_that_leaves_a_triangle_never_meets_it_again_t37),
        cmocka_unit_test(a_ray_that_leaves_a_convex_shape_never_meets_a_neighbor_t37),
        cmocka_unit_test(a_ray_that_leaves_a_sphere_never_meets_it_again_t38),
    };
    return cmocka_run_group_tests(tests, ray_batch_setup, ray_batch_teardown);
}
