// SPDX-License-Identifier: MIT
// Rays whose every step is exact in float, along the axes and in the planes of faces: there is one
// right answer, to the bit.
#include "support/aim.h"
#include "support/check.h"
#include "support/report.h"
#include "support/shapes.h"

#include <stdlib.h>

// The cube fills [-0.5, 0.5]^3 of the frame, its vertices multiples of 1/8.
#define CELLS 8
#define HALF  0.5f

static void cube_stage(Stage *stage, TreeKind tree)
{
    Scene scene = shape_scene(shape_cube(4, CELLS));
    stage_make(stage, &scene, tree);
    scene_free(&scene);
    assert_true(stage->normalization.scale == 0.125);
}

// An axis-parallel ray and the plane it comes to first.
typedef struct {
    TestRay ray;
    int axis;
    float plane; // coordinate of the face on that axis
    float t;
} AxisRay;

// Whether the triangle lies in the face and holds the ray's point of it, its outline included.
static bool face_holds(const AxisRay *ray, const float corners[3][3])
{
    const int x = (ray->axis + 1) % 3, y = (ray->axis + 2) % 3;
    bool positive = true, negative = true;
    for (int corner = 0; corner < 3; corner++) {
        const float *a = corners[corner], *b = corners[(corner + 1) % 3];
        if (a[ray->axis] != ray->plane)
            return false;
        const float edge = (b[x] - a[x]) * (ray->ray.origin[y] - a[y]) -
                           (b[y] - a[y]) * (ray->ray.origin[x] - a[x]);
        positive = positive && edge >= 0;
        negative = negative && edge <= 0;
    }
    return positive || negative;
}

// The lowest id of the triangles that hold the point, which all are equally far.
static TestHit expected_hit(const AxisRay *ray, const Triangles *triangles)
{
    for (size_t i = 0; i < triangles->count; i++) {
        const StageTriangle triangle = stage_triangle(triangles, i);
        if (face_holds(ray, triangle.corners))
            return (TestHit){ray->t, (uint32_t)i};
    }
    return (TestHit){INFINITY, NOTHING};
}

#define STEPS     19 // half cells from one half cell outside to the other side's
#define POSITIONS (STEPS * STEPS)

// Choices of an axis ray: direction, length, distance and signs of the zeros.
typedef struct {
    int axis, zeros;
    float sign, length, distance;
} AxisAim;

static AxisRay axis_ray(const AxisAim *aim, int position)
{
    const int x = (aim->axis + 1) % 3, y = (aim->axis + 2) % 3;
    AxisRay made = {.ray = {.own = NOTHING, .kind = RAY_CAMERA}, .axis = aim->axis};
    // From outside the nearer face comes first, from inside the only one ahead.
    made.plane = aim->distance > 2 * HALF ? -aim->sign * HALF : aim->sign * HALF;
    made.ray.origin[aim->axis] = aim->sign * (HALF - aim->distance);
    made.ray.origin[x] = (float)(position % STEPS - STEPS / 2) / 16;
    made.ray.origin[y] = (float)(position / STEPS - STEPS / 2) / 16;
    made.ray.direction[aim->axis] = aim->sign * aim->length;
    made.ray.direction[x] = aim->zeros & 1 ? -0.0f : 0.0f;
    made.ray.direction[y] = aim->zeros & 2 ? -0.0f : 0.0f;
    made.t = fabsf(made.plane - made.ray.origin[aim->axis]) / aim->length;
    return made;
}

static size_t wrong_axis_rays(const RayBatch *batch, const Triangles *triangles, const AxisAim *aim)
{
    size_t wrong = 0;
    TestRay rays[POSITIONS];
    TestHit hits[POSITIONS];
    for (int position = 0; position < POSITIONS; position++)
        rays[position] = axis_ray(aim, position).ray;
    ray_batch_trace(batch, BATCH_NEAREST, rays, POSITIONS, hits);
    for (int position = 0; position < POSITIONS; position++) {
        const AxisRay ray = axis_ray(aim, position);
        const TestHit expected = expected_hit(&ray, triangles);
        wrong += hits[position].t != expected.t || hits[position].id != expected.id;
    }
    return wrong;
}

// All lengths and distances for one direction; adds the number of rays to *count.
static size_t wrong_along(const RayBatch *batch, const Triangles *triangles, AxisAim aim,
                          size_t *count)
{
    static const float lengths[] = {1, 2, 0.25f};
    static const float distances[] = {0.5f, 0.625f, 1.5f, 3};
    size_t wrong = 0;
    for (int length = 0; length < 3; length++)
        for (int distance = 0; distance < 4; distance++)
            for (aim.zeros = 0; aim.zeros < 4; aim.zeros++) {
                aim.length = lengths[length];
                aim.distance = distances[distance];
                wrong += wrong_axis_rays(batch, triangles, &aim);
                *count += POSITIONS;
            }
    return wrong;
}

static void axis_parallel_rays_meet_a_lattice_cube_exactly_t20(void **state)
{
    size_t wrong = 0;
    for (TreeKind tree = TREE_SAH; tree < TREE_KINDS; tree++) {
        Stage stage;
        char details[32];
        size_t count = 0, failed = 0;
        cube_stage(&stage, tree);
        ray_batch_upload(*state, &stage.flat);
        for (int axis = 0; axis < 3; axis++) {
            failed +=
                wrong_along(*state, &stage.triangles, (AxisAim){.axis = axis, .sign = 1}, &count);
            failed +=
                wrong_along(*state, &stage.triangles, (AxisAim){.axis = axis, .sign = -1}, &count);
        }
        snprintf(details, sizeof details, "tree=%s", tree_names[tree]);
        wrong += report_case("T-20", details, count, failed);
        stage_free(&stage);
    }
    assert_int_equal(wrong, 0);
}

static bool lies_in_plane(const Triangles *triangles, uint32_t number, const float normal[3],
                          float offset)
{
    for (int corner = 0; corner < 3; corner++) {
        const float *at = triangles_corner(triangles, number, corner);
        if (at[0] * normal[0] + at[1] * normal[1] + at[2] * normal[2] != offset)
            return false;
    }
    return true;
}

// In the plane z = 0.5 of the cube's top, from x = -1.5 on toward its edge at x = -0.5.
static TestRay ray_in_top(int start, int slope)
{
    const TestRay ray = {.origin = {-1.5f, (float)start / 16, HALF},
                         .own = NOTHING,
                         .direction = {1, (float)slope / 16, 0},
                         .kind = RAY_CAMERA};
    return ray;
}

// Such a ray meets the side below the edge it reaches first, at the edge, and never the top itself.
static void rays_in_the_plane_of_a_face_meet_its_neighbor_instead_t19(void **state)
{
    Stage stage;
    size_t wrong = 0, count = 0;
    static const float up[3] = {0, 0, 1};
    cube_stage(&stage, TREE_SAH);
    ray_batch_upload(*state, &stage.flat);
    for (int start = -12; start <= 12; start++)
        for (int slope = -12; slope <= 12; slope++) {
            TestHit hit;
            const TestRay ray = ray_in_top(start, slope);
            const bool meets = abs(start + slope) <= 8;
            if (!meets)
                continue;
            ray_batch_trace(*state, BATCH_NEAREST, &ray, 1, &hit);
            wrong += hit.t != 1 || hit.id == NOTHING ||
                     lies_in_plane(&stage.triangles, hit.id, up, HALF);
            count++;
        }
    stage_free(&stage);
    report_case("T-19", "plane=face", count, wrong);
    assert_int_equal(wrong, 0);
}

// The octahedron |x| + |y| + |z| = 4, which the frame makes 0.5.
static void octahedron_stage(Stage *stage)
{
    Error error = {0};
    Scene scene;
    require(scene_init(&scene, &error), &error);
    for (int face = 0; face < 8; face++) {
        const Vec3 x = {face & 1 ? -4 : 4, 0, 0}, y = {0, face & 2 ? -4 : 4, 0};
        shape_add(&scene, shape_triangle(x, y, vec3(0, 0, face & 4 ? -4 : 4)), 1);
    }
    stage_make(stage, &scene, TREE_SAH);
    scene_free(&scene);
}

#define TILTED_RAYS 20000

// In the plane x + y + z = 0.5 toward a point of the face there, all in multiples of 2^-9.  The
// largest component of the direction is 1, so that the shear is exact.
static TestRay ray_in_tilted_plane(Random *random)
{
    const uint32_t x = 1 + random_below(random, 254), y = 1 + random_below(random, 255 - x);
    const int target[3] = {(int)x, (int)y, 256 - (int)(x + y)};
    const int sign = random_below(random, 2) == 0 ? 1 : -1;
    const int second = (int)random_below(random, 513);
    const int direction[3] = {-512 * sign, second * sign, (512 - second) * sign};
    const uint32_t turn = random_below(random, 3);
    TestRay ray = {.own = NOTHING, .kind = RAY_CAMERA};
    for (uint32_t axis = 0; axis < 3; axis++) {
        ray.direction[axis] = (float)direction[(axis + turn) % 3] * 0x1p-9f;
        ray.origin[axis] = (float)(target[axis] - 2 * direction[(axis + turn) % 3]) * 0x1p-9f;
    }
    return ray;
}

static void rays_in_a_tilted_plane_meet_a_neighbor_instead_t19(void **state)
{
    Stage stage;
    Random random = {19};
    size_t wrong = 0;
    static const float normal[3] = {1, 1, 1};
    static TestRay rays[TILTED_RAYS];
    static TestHit hits[TILTED_RAYS];
    octahedron_stage(&stage);
    ray_batch_upload(*state, &stage.flat);
    for (int i = 0; i < TILTED_RAYS; i++)
        rays[i] = ray_in_tilted_plane(&random);
    ray_batch_trace(*state, BATCH_NEAREST, rays, TILTED_RAYS, hits);
    for (int i = 0; i < TILTED_RAYS; i++)
        wrong += hits[i].id == NOTHING || !(hits[i].t < INFINITY) ||
                 lies_in_plane(&stage.triangles, hits[i].id, normal, HALF);
    stage_free(&stage);
    report_case("T-19", "plane=tilted", TILTED_RAYS, wrong);
    assert_int_equal(wrong, 0);
}

#define SOUP      2000
#define SOUP_RAYS 200000

static Vec3 vector_of(const float values[3])
{
    return vec3((double)values[0], (double)values[1], (double)values[2]);
}

// A ray in the plane of a random triangle, as well as float can say it.
static TestRay ray_in_triangle(const Triangles *triangles, Random *random)
{
    const uint32_t number = random_below(random, (uint32_t)triangles->count);
    const Vec3 a = aim_corner(triangles, number, 0);
    const Vec3 first = vec3_sub(aim_corner(triangles, number, 1), a);
    const Vec3 second = vec3_sub(aim_corner(triangles, number, 2), a);
    Vec3 ends[2];
    for (int i = 0; i < 2; i++) {
        const double reach = i == 0 ? 10 : 1;
        ends[i] = vec3_add(a, vec3_add(vec3_scale(first, random_between(random, -reach, reach)),
                                       vec3_scale(second, random_between(random, -reach, reach))));
    }
    return aim_at(ends[0], ends[1]);
}

// The point that is reported lies within 22 units of rounding of the largest distance between
// origin and corners along each axis (the proof of the box slack), and the two of its own rounding.
static bool hit_lies_on_triangle(const TestRay *ray, const TestHit *hit, const float corners[3][3])
{
    double reach = 0;
    const Vec3 origin = vector_of(ray->origin);
    for (int corner = 0; corner < 3; corner++)
        reach = fmax(reach, vec3_extent(vec3_sub(vector_of(corners[corner]), origin)));
    const Vec3 point = vec3_add(origin, vec3_scale(vector_of(ray->direction), (double)hit->t));
    return triangle_distance_to(corners, point) <= sqrt(3) * 24 * 0x1p-24 * reach;
}

static void hits_of_rays_in_a_triangles_plane_lie_on_what_they_hit_t19(void **state)
{
    Stage stage;
    Random random = {1919};
    size_t wrong = 0, hits_seen = 0;
    static TestRay rays[SOUP_RAYS];
    static TestHit hits[SOUP_RAYS];
    Scene scene = shape_scene(shape_soup(&random, SOUP, 0.2));
    stage_make(&stage, &scene, TREE_SAH);
    ray_batch_upload(*state, &stage.flat);
    for (int i = 0; i < SOUP_RAYS; i++)
        rays[i] = ray_in_triangle(&stage.triangles, &random);
    ray_batch_trace(*state, BATCH_NEAREST, rays, SOUP_RAYS, hits);
    for (int i = 0; i < SOUP_RAYS; i++) {
        if (hits[i].id == NOTHING)
            continue;
        hits_seen++;
        const StageTriangle triangle = stage_triangle(&stage.triangles, hits[i].id);
        wrong += !hit_lies_on_triangle(&rays[i], &hits[i], triangle.corners);
    }
    stage_free(&stage);
    scene_free(&scene);
    report_case("T-19", "plane=random", hits_seen, wrong);
    assert_in_range(hits_seen, SOUP_RAYS / 4, SOUP_RAYS);
    assert_int_equal(wrong, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_in_the_plane_of_a_face_meet_its_neighbor_instead_t19),
        cmocka_unit_test(rays_in_a_tilted_plane_meet_a_neighbor_instead_t19),
        cmocka_unit_test(hits_of_rays_in_a_triangles_plane_lie_on_what_they_hit_t19),
        cmocka_unit_test(axis_parallel_rays_meet_a_lattice_cube_exactly_t20),
    };
    return cmocka_run_group_tests(tests, ray_batch_setup, ray_batch_teardown);
}
