// SPDX-License-Identifier: MIT
// Rays toward points well inside an open shape's outline must hit the shape, even at edges that two
// triangles share.
#include "support/rig.h"
#include "support/shapes.h"

#define QUAD_RAYS 1024

// Rays start on one side of the unit quad that axes 0 and 1 span. They go to points of the quad's
// diagonal.
static Outcome judge_diagonal(RayBatch *batch, const Vec3 axes[3], Random *random)
{
    Vec3 from = {0};
    TestRay rays[QUAD_RAYS];
    FREED_BY(rig_close)
    Rig rig = rig_open("T-05", batch, shape_scene(shape_plane(vec3(0, 0, 0), axes[0], axes[1], 1)));
    for (size_t i = 0; i < QUAD_RAYS; i++) {
        const double place = random_between(random, 0.01, 0.99);
        if (rays_move_origin(i, 64)) {
            from = random_in_cube(random, 2);
            from.z = random_between(random, 0.5, 3);
        }
        rays[i] =
            ray_between_in(&rig.stage, rotated(axes, from), rotated(axes, vec3(place, place, 0)));
    }
    return rig_judge(&rig, (Rays){rays, QUAD_RAYS}, judge_misses, NULL);
}

EXTREME(no_ray_slips_through_the_diagonal_of_a_rotated_quad_t05)
{
    Random random = {5};
    // The first rotation is by 90 degrees around (1, 1, 1).
    const double a = 1.0 / 3, b = sqrt(a);
    const Vec3 turned[3] = {{a, a + b, a - b}, {a - b, a, a + b}, {a + b, a - b, a}};
    const size_t rotations = tier_size(100, 1000);
    Outcome sum = judge_diagonal(*state, turned, &random);
    for (size_t i = 1; i < rotations; i++) {
        Vec3 rotation[3], axes[3];
        random_rotation(&random, rotation);
        for (int axis = 0; axis < 3; axis++)
            axes[axis] = rotated(rotation, turned[axis]);
        outcome_add(&sum, judge_diagonal(*state, axes, &random));
    }
    outcome_report(sum, "rotations=%zu", rotations);
}

// Returns two triangles a b c and b a d that share the edge a b, with c and d on opposite sides.
static Scene random_pair(Random *random)
{
    static const Vec3 places[4] = {{0, 2, 0}, {0, -2, 0}, {2, 0, 0}, {-2, 0, 0}};
    Vec3 corners[4];
    for (int corner = 0; corner < 4; corner++) {
        corners[corner] = random_in_cube(random, 0.5);
        corners[corner].z *= 0.2;
        corners[corner] = vec3_add(corners[corner], places[corner]);
    }
    Scene scene = shape_scene(shape_triangle(corners[0], corners[1], corners[2]));
    shape_add(&scene, shape_triangle(corners[1], corners[0], corners[3]), 1);
    return scene;
}

static Outcome judge_pair(RayBatch *batch, Random *random)
{
    Vec3 from = {0};
    FREED_BY(rays_free) const Rays rays = rays_make(50000);
    FREED_BY(rig_close) Rig rig = rig_open("T-06", batch, random_pair(random));
    for (size_t i = 0; i < rays.count; i++) {
        const double along = random_between(random, 0.01, 0.99);
        if (rays_move_origin(i, 64))
            from = normalize_point(&rig.stage.normalization,
                                   vec3_add(random_in_cube(random, 1), vec3(0, 0, 3)));
        rays.data[i] = ray_between(from, point_of(&rig.stage.triangles, 0, along, 0));
    }
    return rig_judge(&rig, rays, judge_misses, NULL);
}

static void judge_pairs(RayBatch *batch, const char *contraction)
{
    Outcome sum = {0};
    Random random = {6};
    for (size_t pair = 0; pair < tier_size(2, 8); pair++)
        outcome_add(&sum, judge_pair(batch, &random));
    outcome_report(sum, "contraction=%s", contraction);
}

EXTREME(no_ray_slips_between_two_triangles_whether_contracted_or_not_t06)
{
    RayBatch contracted;
    judge_pairs(*state, "off");
    ray_batch_open(&contracted, CONTRACTED_KERNELS, NULL);
    judge_pairs(&contracted, "on");
    ray_batch_close(&contracted);
}

#define PLANE_X 148376.0

typedef enum { PLANE_POINTS, PLANE_EDGES, PLANE_VERTICES } PlaneTarget;

// Returns a point of the plane, a point of a line of its grid, or a vertex, in scene coordinates.
static Vec3 plane_target(PlaneTarget kind, Random *random)
{
    const double cell = 12.0 / 200;
    Vec3 target = {PLANE_X, random_between(random, -5.9, 5.9), random_between(random, -5.9, 5.9)};
    if (kind != PLANE_POINTS)
        target.y = shape_rounded(-6 + cell * rint((target.y + 6) / cell));
    if (kind == PLANE_VERTICES)
        target.z = shape_rounded(-6 + cell * rint((target.z + 6) / cell));
    return target;
}

// Rays start about `distance` from the plane. A larger distance makes them more nearly parallel.
static void judge_plane(const Rig *rig, double distance, PlaneTarget kind)
{
    static const char *const names[] = {"points", "edges", "vertices"};
    Random random = {(uint64_t)(8000 + kind)};
    Vec3 from = {0};
    FREED_BY(rays_free) const Rays rays = rays_make(tier_size(20000, 250000));
    for (size_t i = 0; i < rays.count; i++) {
        if (rays_move_origin(i, 64))
            from = vec3_sub(random_in_cube(&random, 2), vec3(distance - PLANE_X, 0, 0));
        rays.data[i] = ray_between_in(&rig->stage, from, plane_target(kind, &random));
    }
    outcome_report(rig_judge(rig, rays, judge_misses, NULL), "aim=%s distance=%g", names[kind],
                   distance);
}

EXTREME(no_ray_passes_a_plane_far_from_the_origin_t08)
{
    FREED_BY(rig_close)
    Rig rig = rig_open(
        "T-08", *state,
        shape_scene(shape_plane(vec3(PLANE_X, -6, -6), vec3(0, 12, 0), vec3(0, 0, 12), 200)));
    judge_plane(&rig, 2.5, PLANE_POINTS);
    judge_plane(&rig, 2.5, PLANE_EDGES);
    judge_plane(&rig, 2.5, PLANE_VERTICES);
    judge_plane(&rig, PLANE_X, PLANE_EDGES);
}

FIXTURES(ray_batch_setup, ray_batch_teardown)
