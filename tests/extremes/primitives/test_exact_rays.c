// SPDX-License-Identifier: MIT
// Traces rays along the axes and in the planes of triangles. Except for rays in planes of random
// triangles, every step is exact in float, so the right answers are known to the bit.
#include "support/rig.h"
#include "support/shapes.h"

// In normalized coordinates, the cube is [-0.5, 0.5]^3 and its vertices are multiples of 1/8.
#define HALF 0.5f

static Rig open_cube(const char *test, RayBatch *batch, TreeKind tree)
{
    const Rig rig = rig_open_with(test, batch, shape_scene(shape_cube(4, 8)), tree);
    assert_true(rig.stage.normalization.scale == 0.125);
    return rig;
}

// An axis-parallel ray, and the face of the cube that the ray meets first.
typedef struct {
    TestRay ray;
    int axis;
    float plane; // the face's coordinate on that axis
    float t;
} AxisRay;

#define STEPS     19 // points across the cube, half a cell apart, and one outside on each side
#define AXIS_RAYS (3 * 2 * 3 * 4 * 4 * STEPS * STEPS)

// The mixed-radix digits of `number` choose axis, sign, length, distance, signs of zeros, and
// position.
static AxisRay axis_ray(size_t number)
{
    static const float lengths[] = {1, 2, 0.25f}, distances[] = {0.5f, 0.625f, 1.5f, 3};
    const int axis = (int)(number % 3), x = (axis + 1) % 3, y = (axis + 2) % 3;
    const float sign = number / 3 % 2 == 0 ? 1 : -1;
    const float length = lengths[number / 6 % 3], distance = distances[number / 18 % 4];
    const int zeros = (int)(number / 72 % 4), position = (int)(number / 288);
    AxisRay made = {.ray = {.own = NOTHING, .kind = RAY_CAMERA}, .axis = axis};
    // A ray from outside meets the nearer face first. A ray from inside meets the face ahead of it.
    made.plane = distance > 2 * HALF ? -sign * HALF : sign * HALF;
    made.ray.origin[axis] = sign * (HALF - distance);
    made.ray.origin[x] = (float)(position % STEPS - STEPS / 2) / 16;
    made.ray.origin[y] = (float)(position / STEPS - STEPS / 2) / 16;
    made.ray.direction[axis] = sign * length;
    made.ray.direction[x] = zeros & 1 ? -0.0f : 0.0f;
    made.ray.direction[y] = zeros & 2 ? -0.0f : 0.0f;
    made.t = fabsf(made.plane - made.ray.origin[axis]) / length;
    return made;
}

// Returns whether the triangle is in the face and contains the ray's point, inside or on the
// outline.
static bool face_holds(const AxisRay *ray, const Triangles *triangles, size_t triangle)
{
    const int x = (ray->axis + 1) % 3, y = (ray->axis + 2) % 3;
    bool positive = true, negative = true;
    for (int corner = 0; corner < 3; corner++) {
        const float *a = triangles_corner(triangles, triangle, corner);
        const float *b = triangles_corner(triangles, triangle, (corner + 1) % 3);
        if (a[ray->axis] != ray->plane)
            return false;
        const float edge = (b[x] - a[x]) * (ray->ray.origin[y] - a[y]) -
                           (b[y] - a[y]) * (ray->ray.origin[x] - a[x]);
        positive = positive && edge >= 0;
        negative = negative && edge <= 0;
    }
    return positive || negative;
}

// All triangles that contain the point are at one distance. The lowest id must be the hit.
static bool judge_axis_ray(void *context, const Traced *traced)
{
    const Triangles *triangles = context;
    const AxisRay ray = axis_ray(traced->index);
    for (size_t i = 0; i < triangles->count; i++)
        if (face_holds(&ray, triangles, i))
            return traced->hit->t != ray.t || traced->hit->id != i;
    return traced->hit->t != INFINITY || traced->hit->id != NOTHING;
}

EXTREME(axis_parallel_rays_meet_a_lattice_cube_exactly_t20)
{
    FREED_BY(rays_free) const Rays rays = rays_make(AXIS_RAYS);
    for (size_t i = 0; i < rays.count; i++)
        rays.data[i] = axis_ray(i).ray;
    for (TreeKind tree = TREE_SAH; tree < TREE_KINDS; tree++) {
        FREED_BY(rig_close) Rig rig = open_cube("T-20", *state, tree);
        outcome_report(rig_judge(&rig, rays, judge_axis_ray, &rig.stage.triangles), "tree=%s",
                       tree_names[tree]);
    }
}

// The plane of a face of the octahedron. Its points have the dot product HALF with `normal`.
typedef struct {
    const Triangles *triangles;
    Vec3 normal;
} Plane;

// A ray in the plane must hit a triangle that is not in the plane.
static bool judge_plane(void *context, const Traced *traced)
{
    const Plane *plane = context;
    bool is_in_plane = true;
    if (judge_misses(NULL, traced))
        return true;
    for (size_t corner = 0; corner < 3; corner++) {
        const Vec3 point = corner_of(plane->triangles, traced->hit->id, corner);
        is_in_plane = is_in_plane && vec3_dot(point, plane->normal) == (double)HALF;
    }
    return is_in_plane;
}

// Returns the octahedron |x| + |y| + |z| = 4. In normalized coordinates, the sum is 0.5.
static Scene octahedron(void)
{
    Error error = {0};
    Scene scene;
    require(scene_init(&scene, &error), &error);
    for (int face = 0; face < 8; face++) {
        const Vec3 x = {face & 1 ? -4 : 4, 0, 0}, y = {0, face & 2 ? -4 : 4, 0};
        shape_add(&scene, shape_triangle(x, y, vec3(0, 0, face & 4 ? -4 : 4)), 1);
    }
    return scene;
}

// Returns a ray in the plane x + y + z = 0.5 toward a point of a face of the octahedron. All
// coordinates are multiples of 2^-9. The direction's largest component is 1 or -1, so the shear is
// exact.
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

EXTREME(rays_in_a_tilted_plane_meet_a_neighbor_instead_t19)
{
    Random random = {19};
    FREED_BY(rays_free) const Rays rays = rays_make(20000);
    FREED_BY(rig_close) Rig rig = rig_open("T-19", *state, octahedron());
    Plane plane = {&rig.stage.triangles, {1, 1, 1}};
    for (size_t i = 0; i < rays.count; i++)
        rays.data[i] = ray_in_tilted_plane(&random);
    outcome_report(rig_judge(&rig, rays, judge_plane, &plane), "plane=tilted");
}

// Returns a ray in the plane of a random triangle, as exactly as float allows.
static TestRay ray_in_triangle(const Triangles *triangles, Random *random)
{
    const uint32_t triangle = random_below(random, (uint32_t)triangles->count);
    double places[4];
    for (int i = 0; i < 4; i++)
        places[i] = random_between(random, i < 2 ? -10 : -1, i < 2 ? 10 : 1);
    return ray_between(point_of(triangles, triangle, places[0], places[1]),
                       point_of(triangles, triangle, places[2], places[3]));
}

typedef struct {
    const Triangles *triangles;
    size_t hits;
} Soup;

// Along each axis, the error of the hit point is at most 24 units. A unit is 2^-24 times the
// largest distance from the ray's origin to a corner. The proof of BVH_SLACK (shared.h) gives 22
// units, and the computation of the point adds 2.
static bool judge_point(void *context, const Traced *traced)
{
    Soup *soup = context;
    double reach = 0;
    const uint32_t id = traced->hit->id;
    const Vec3 origin = vec3_of_floats(traced->ray->origin);
    const Vec3 along = vec3_scale(vec3_of_floats(traced->ray->direction), (double)traced->hit->t);
    if (id == NOTHING)
        return false;
    soup->hits += traced->tracer == BY_CLRT;
    for (size_t corner = 0; corner < 3; corner++)
        reach = fmax(reach, vec3_extent(vec3_sub(corner_of(soup->triangles, id, corner), origin)));
    const double distance = distance_to_triangle(soup->triangles, id, vec3_add(origin, along));
    return !(distance <= sqrt(3) * 24 * 0x1p-24 * reach);
}

EXTREME(hits_of_rays_in_a_triangles_plane_lie_on_the_triangle_t19)
{
    Random random = {1919};
    FREED_BY(rays_free) const Rays rays = rays_make(200000);
    FREED_BY(rig_close)
    Rig rig = rig_open("T-19", *state, shape_scene(shape_soup(&random, 2000, 0.2)));
    Soup soup = {&rig.stage.triangles, 0};
    for (size_t i = 0; i < rays.count; i++)
        rays.data[i] = ray_in_triangle(soup.triangles, &random);
    Outcome outcome = rig_judge(&rig, rays, judge_point, &soup);
    outcome.count = soup.hits;
    outcome_report(outcome, "plane=random");
    assert_in_range(soup.hits, rays.count / 4, rays.count);
}

FIXTURES(ray_batch_setup, ray_batch_teardown)
