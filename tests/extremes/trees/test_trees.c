// SPDX-License-Identifier: MIT
// The trees of both builders must give the same hits, to the bit, as testing all primitives.
#include "support/rig.h"
#include "support/shapes.h"
#include "support/tree_scenes.h"

#include <string.h>

// Returns a point of the line through an edge of a random triangle.
static Vec3 random_target(const Triangles *triangles, Random *random)
{
    const uint32_t triangle = random_below(random, (uint32_t)triangles->count);
    return point_of(triangles, triangle, random_between(random, -0.2, 1.2), 0);
}

static TestRay along_an_axis(Vec3 through, Random *random)
{
    const uint32_t axis = random_below(random, 3);
    const double sign = random_below(random, 2) == 0 ? -1 : 1;
    const Vec3 step = {axis == 0 ? sign : 0, axis == 1 ? sign : 0, axis == 2 ? sign : 0};
    TestRay ray = ray_between(vec3_sub(through, vec3_scale(step, 2)), through);
    shape_store(ray.direction, step);
    return ray;
}

// Makes random rays, rays at vertices and edges, rays from afar and from vertices, and rays along
// the axes.
static void make_free_rays(Rays rays, const Triangles *triangles, Random *random)
{
    Vec3 near = {0}, far = {0};
    for (size_t i = 0; i < rays.count; i++) {
        if (rays_move_origin(i, RAY_BUNDLE)) {
            near = random_in_cube(random, 2);
            far = random_in_cube(random, 1000);
        }
        Vec3 origin = i % 8 == 4 ? far : near;
        Vec3 target = random_in_cube(random, 1);
        if (i % 8 == 1 || i % 8 == 2)
            target = rays_target(AIM_VERTICES, triangles, random);
        else if (i % 8 == 3 || i % 8 == 4)
            target = random_target(triangles, random);
        else if (i % 8 == 5)
            origin = rays_target(AIM_VERTICES, triangles, random);
        rays.data[i] = i % 8 == 6
                           ? along_an_axis(rays_target(AIM_VERTICES, triangles, random), random)
                           : ray_between(origin, target);
    }
}

// Makes rays from points of triangles at or near an edge. Neighboring triangles are so close to the
// ray's start that rounding can make their distance along the ray zero or less.
static void make_surface_rays(Rays rays, const Stage *stage, Random *random)
{
    const Triangles *triangles = &stage->triangles;
    for (size_t i = 0; i < rays.count; i++) {
        const uint32_t triangle = random_below(random, (uint32_t)triangles->count);
        const double along = random_between(random, 0, 1);
        const double inward = scalbn(random_between(random, 0, 1), -(int)random_below(random, 30));
        const Vec3 origin = point_of(triangles, triangle, along * (1 - inward), inward);
        rays.data[i] = ray_between(origin, vec3_add(origin, random_in_cube(random, 1)));
        rays.data[i].own = stage->flat.sphere_count + triangle;
        rays.data[i].kind = RAY_REFLECTED;
    }
}

static void make_rays(Rays rays, size_t number, BatchTask task, bool from_surfaces)
{
    Stage stage;
    Random random = {25 + number};
    FREED_BY(scene_free) Scene scene = tree_scene_make(number);
    stage_make(&stage, &scene, TREE_NONE);
    if (from_surfaces)
        make_surface_rays(rays, &stage, &random);
    else
        make_free_rays(rays, &stage.triangles, &random);
    stage_free(&stage);
    for (size_t i = 0; i < rays.count && task == BATCH_BLOCKED; i++) {
        rays.data[i].kind = RAY_SHADOW;
        // A shadow ray of doubled length passes its target or, along an axis, ends at its target.
        for (int axis = 0; axis < 3 && !from_surfaces && i % 16 < 8; axis++)
            rays.data[i].direction[axis] *= 2;
    }
}

static TestHit *trace(RayBatch *batch, BatchTask task, Rays rays, size_t number, TreeKind tree)
{
    Stage stage;
    FREED_BY(scene_free) Scene scene = tree_scene_make(number);
    stage_make(&stage, &scene, tree);
    ray_batch_upload(batch, &stage.flat);
    stage_free(&stage);
    return ray_batch_trace(batch, task, rays);
}

static void compare_trees(RayBatch *batch, BatchTask task, bool from_surfaces)
{
    FREED_BY(rays_free) const Rays rays = rays_make(tier_size(10000, 100000));
    const uint32_t nothing = task == BATCH_BLOCKED ? 0 : NOTHING;
    const size_t least_met = rays.count / (task == BATCH_BLOCKED ? 100 : 20);
    for (size_t number = 0; number < TREE_SCENES; number++) {
        size_t met = 0;
        make_rays(rays, number, task, from_surfaces);
        TestHit *expected = trace(batch, task, rays, number, TREE_NONE);
        for (size_t i = 0; i < rays.count; i++)
            met += expected[i].id != nothing;
        assert_in_range(met, from_surfaces ? 0 : least_met, rays.count);
        for (TreeKind tree = TREE_SAH; tree < TREE_NONE; tree++) {
            size_t wrong = 0;
            TestHit *found = trace(batch, task, rays, number, tree);
            for (size_t i = 0; i < rays.count; i++)
                wrong += memcmp(&found[i], &expected[i], sizeof *found) != 0;
            outcome_report(outcome_of("T-25", rays.count, wrong),
                           "scene=%s tree=%s task=%s from=%s", tree_scene_names[number],
                           tree_names[tree], task == BATCH_NEAREST ? "nearest" : "blocked",
                           from_surfaces ? "surfaces" : "anywhere");
            free(found);
        }
        free(expected);
    }
}

EXTREME(every_tree_finds_the_hits_that_testing_all_triangles_finds_t25)
{
    compare_trees(*state, BATCH_NEAREST, false);
    compare_trees(*state, BATCH_NEAREST, true);
}

EXTREME(every_tree_finds_the_shadows_that_testing_all_triangles_finds_t25)
{
    compare_trees(*state, BATCH_BLOCKED, false);
    compare_trees(*state, BATCH_BLOCKED, true);
}

FIXTURES(ray_batch_setup, ray_batch_teardown)
