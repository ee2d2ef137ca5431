// SPDX-License-Identifier: MIT
// Casts rays at a bumpy ball.
#include "library/closed_meshes.h"
#include "library/faults.h"
#include "library/renderer.h"
#include "unit/random.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define RAYS 20000

static ClosedMesh mesh;
static Position *vertices;
static double origins[RAYS][3], directions[RAYS][3];
static ClrtScene *scene;

static ClrtScene *mesh_scene(void)
{
    const ClrtMesh given = {.size = sizeof given,
                            .positions = vertices[0],
                            .triangles = mesh.faces[0],
                            .vertex_count = mesh.vertex_count,
                            .triangle_count = mesh.face_count};
    ClrtScene *made = clrt_scene_create(NULL);
    assert_true(clrt_scene_add_mesh(made, &given, NULL));
    return made;
}

SET_UP(make_rays)
{
    uint64_t numbers = 7;
    mesh = closed_mesh_make(CLOSED_BUMPY);
    vertices = closed_mesh_positions(&mesh);
    scene = mesh_scene();
    for (int i = 0; i < RAYS; i++)
        for (int axis = 0; axis < 3; axis++) {
            origins[i][axis] = random_between(&numbers, -2, 2);
            directions[i][axis] = random_between(&numbers, -0.5, 0.5) - origins[i][axis];
        }
    return scene == NULL;
}

TEAR_DOWN(free_scene)
{
    clrt_scene_free(scene);
    free(vertices);
    closed_mesh_free(&mesh);
    return 0;
}

static ClrtRays rays_given(size_t count)
{
    return (ClrtRays){.size = sizeof(ClrtRays),
                      .count = count,
                      .origins = origins[0],
                      .directions = directions[0]};
}

typedef struct {
    double distances[RAYS], weights[RAYS][2], normals[RAYS][3];
    uint32_t primitives[RAYS], meshes[RAYS], triangles[RAYS];
    uint8_t fronts[RAYS], certain[RAYS];
} Results;

static ClrtHits hits_in(Results *results, size_t first)
{
    return (ClrtHits){.size = sizeof(ClrtHits),
                      .distances = results->distances + first,
                      .primitives = results->primitives + first,
                      .meshes = results->meshes + first,
                      .triangles = results->triangles + first,
                      .weights = results->weights[first],
                      .normals = results->normals[first],
                      .fronts = results->fronts + first,
                      .certain = results->certain + first};
}

static Results all, others, inward;

static void trace_all_by(ClrtRenderer *by, Results *results)
{
    const ClrtRays rays = rays_given(RAYS);
    const ClrtHits hits = hits_in(results, 0);
    memset(results, 0x55, sizeof *results);
    assert_true(clrt_trace(by, scene, &rays, &hits, NULL));
}

TEST(hits_have_a_place_on_the_mesh)
{
    size_t found = 0;
    trace_all_by(renderer, &all);
    for (size_t i = 0; i < RAYS; i++) {
        const uint32_t *face = mesh.faces[all.triangles[i] % mesh.face_count];
        const double second = all.weights[i][0], third = all.weights[i][1];
        if (all.primitives[i] == CLRT_NOTHING) {
            assert_true(all.distances[i] == INFINITY && all.meshes[i] == CLRT_NOTHING);
            continue;
        }
        double facing = 0;
        found++;
        assert_int_equal(all.meshes[i], 0);
        assert_int_equal(all.triangles[i], all.primitives[i]);
        for (int axis = 0; axis < 3; axis++) {
            const double point = origins[i][axis] + all.distances[i] * directions[i][axis];
            const double on_face = (1 - second - third) * vertices[face[0]][axis] +
                                   second * vertices[face[1]][axis] +
                                   third * vertices[face[2]][axis];
            facing += all.normals[i][axis] * directions[i][axis];
            // Along and across the ray, errors are at most 18 * 2^-24 times a distance below 6.
            assert_true(fabs(point - on_face) < 12 * 18 * 0x1p-24);
        }
        assert_int_equal(all.fronts[i], facing <= 0);
    }
    assert_true(found > RAYS / 2);
}

static uint32_t starts[RAYS];
static double meetings[RAYS][3], onward[RAYS][3];

// Continues the rays that hit the outside of the ball into the ball. Returns their number.
static size_t trace_inward(ClrtRenderer *by, const Results *outside, Results *results)
{
    size_t count = 0;
    for (size_t i = 0; i < RAYS; i++) {
        if (outside->primitives[i] == CLRT_NOTHING || !outside->fronts[i])
            continue;
        for (int axis = 0; axis < 3; axis++) {
            meetings[count][axis] = origins[i][axis] + outside->distances[i] * directions[i][axis];
            onward[count][axis] = directions[i][axis];
        }
        starts[count++] = outside->primitives[i];
    }
    const ClrtRays rays = {.size = sizeof rays,
                           .count = count,
                           .origins = meetings[0],
                           .directions = onward[0],
                           .starts = starts};
    const ClrtHits hits = hits_in(results, 0);
    memset(results, 0x55, sizeof *results);
    assert_true(clrt_trace(by, scene, &rays, &hits, NULL));
    return count;
}

TEST(batches_and_kernels_change_no_bit)
{
    const ClrtSettings settings[] = {
        {.size = sizeof *settings, .kernel = CLRT_KERNEL_PAIR},
        {.size = sizeof *settings, .kernel = CLRT_KERNEL_WIDE, .lanes = 4},
        {.size = sizeof *settings, .tree = CLRT_TREE_NONE}};
    static uint8_t inside[RAYS], others_inside[RAYS], occluded[RAYS];
    const ClrtRays all_rays = rays_given(RAYS);
    trace_all_by(renderer, &all);
    assert_true(clrt_contains(renderer, scene, &all_rays, inside, NULL));
    trace_inward(renderer, &all, &inward);
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        ClrtRenderer *other = clrt_renderer_create(&settings[i], NULL);
        assert_non_null(other);
        trace_all_by(other, &others);
        assert_memory_equal(&others, &all, sizeof all);
        trace_inward(other, &all, &others);
        assert_memory_equal(&others, &inward, sizeof inward);
        assert_true(clrt_contains(other, scene, &all_rays, others_inside, NULL));
        assert_memory_equal(others_inside, inside, sizeof inside);
        assert_true(clrt_occluded(other, scene, &all_rays, occluded, NULL));
        for (size_t ray = 0; ray < RAYS; ray++)
            assert_int_equal(occluded[ray], all.primitives[ray] != CLRT_NOTHING);
        clrt_renderer_free(other);
    }
    memset(&others, 0x55, sizeof others);
    for (size_t first = 0, count = 1; first < RAYS; first += count) {
        count = RAYS - first < 97 ? RAYS - first : 97;
        ClrtRays rays = rays_given(count);
        const ClrtHits hits = hits_in(&others, first);
        rays.origins += 3 * first;
        rays.directions += 3 * first;
        assert_true(clrt_trace(renderer, scene, &rays, &hits, NULL));
    }
    assert_memory_equal(&others, &all, sizeof all);
}

static double eyes[RAYS][3], aims[RAYS][3];

static void aim_in_rows(size_t width)
{
    for (size_t i = 0; i < RAYS; i++) {
        eyes[i][0] = 0.1;
        eyes[i][1] = 0.2;
        eyes[i][2] = 3;
        aims[i][0] = 2.0 * (double)(i % width) / (double)width - 1;
        aims[i][1] = 2.0 * (double)(i / width) * (double)width / RAYS - 1;
        aims[i][2] = -2;
    }
}

static void trace_aims(size_t first, size_t count, Results *results)
{
    const ClrtRays rays = {
        .size = sizeof rays, .count = count, .origins = eyes[first], .directions = aims[first]};
    ClrtHits hits = hits_in(results, first);
    hits.certain = NULL;
    assert_true(clrt_trace(renderer, scene, &rays, &hits, NULL));
}

// clrt traces rows of rays in blocks (ray_batch.c). Batches of 20 rays are too small for blocks.
TEST(rays_in_rows_have_the_hits_of_rays_in_small_batches)
{
    static const size_t widths[] = {16, 100, 133, 3000, 9999};
    for (size_t i = 0; i < sizeof widths / sizeof *widths; i++) {
        size_t found = 0;
        memset(&all, 0, sizeof all);
        memset(&others, 0, sizeof others);
        aim_in_rows(widths[i]);
        trace_aims(0, RAYS, &all);
        for (size_t first = 0; first < RAYS; first += 20)
            trace_aims(first, 20, &others);
        assert_memory_equal(&others, &all, sizeof all);
        for (size_t ray = 0; ray < RAYS; ray++)
            found += all.primitives[ray] != CLRT_NOTHING;
        assert_true(found > RAYS / 10 && found < RAYS);
    }
}

TEST(rays_at_vertices_hit_and_cross_once)
{
    static uint32_t counts[RAYS], primitives[RAYS];
    static uint8_t inside[RAYS];
    const double eye[3] = {0.01, 0.02, 0.03};
    for (size_t i = 0; i < mesh.vertex_count; i++)
        for (int axis = 0; axis < 3; axis++) {
            eyes[i][axis] = eye[axis];
            aims[i][axis] = vertices[i][axis] - eye[axis];
        }
    const ClrtRays rays = {
        .size = sizeof rays, .count = mesh.vertex_count, .origins = eyes[0], .directions = aims[0]};
    const ClrtHits hits = {.size = sizeof hits, .primitives = primitives};
    const ClrtHits crossings = {.size = sizeof crossings, .counts = counts};
    assert_true(clrt_trace(renderer, scene, &rays, &hits, NULL));
    assert_true(clrt_trace_all(renderer, scene, &rays, &crossings, NULL));
    assert_true(clrt_contains(renderer, scene, &rays, inside, NULL));
    for (size_t i = 0; i < mesh.vertex_count; i++) {
        assert_true(primitives[i] != CLRT_NOTHING);
        assert_int_equal(counts[i] % 2, 1);
        assert_true(inside[i]);
    }
}

TEST(crossings_are_in_order_and_begin_with_the_hit)
{
    enum { ROOM = 3 };
    static double distances[RAYS][ROOM];
    static uint32_t primitives[RAYS][ROOM], counts[RAYS];
    static uint8_t inside[RAYS], upward[RAYS];
    const ClrtRays rays = rays_given(RAYS);
    const ClrtHits hits = {.size = sizeof hits,
                           .distances = distances[0],
                           .primitives = primitives[0],
                           .counts = counts,
                           .room = ROOM};
    ClrtRays points = rays;
    points.directions = NULL;
    trace_all_by(renderer, &all);
    assert_true(clrt_trace_all(renderer, scene, &rays, &hits, NULL));
    assert_true(clrt_contains(renderer, scene, &rays, inside, NULL));
    assert_true(clrt_contains(renderer, scene, &points, upward, NULL));
    for (size_t i = 0; i < RAYS; i++) {
        assert_int_equal(inside[i], counts[i] % 2);
        assert_int_equal(inside[i], upward[i]);
        assert_int_equal(primitives[i][0], all.primitives[i]);
        assert_true(distances[i][0] == all.distances[i]);
        for (uint32_t k = 1; k < ROOM; k++)
            assert_true(k < counts[i] ? distances[i][k] >= distances[i][k - 1]
                                      : primitives[i][k] == CLRT_NOTHING);
    }
}

TEST(rays_that_start_on_a_triangle_leave_it)
{
    uint32_t primitives[2];
    trace_all_by(renderer, &all);
    const size_t count = trace_inward(renderer, &all, &inward);
    assert_true(count > RAYS / 4);
    for (size_t i = 0; i < count; i++) {
        assert_true(inward.primitives[i] != CLRT_NOTHING); // the mesh is closed
        assert_true(inward.primitives[i] != starts[i]);
    }
    const ClrtRays wrong = {.size = sizeof wrong,
                            .count = 1,
                            .origins = meetings[0],
                            .directions = onward[0],
                            .starts = starts};
    const ClrtHits few = {.size = sizeof few, .primitives = primitives};
    starts[0] = (uint32_t)mesh.face_count;
    REFUSES(clrt_trace(renderer, scene, &wrong, &few, &error), "ray 0 starts on primitive");
    starts[0] = 0;
    meetings[0][2] += 1;
    REFUSES(clrt_trace(renderer, scene, &wrong, &few, &error), "from its plane; at most");
}

TEST(limits_end_rays)
{
    static double nears[RAYS], fars[RAYS];
    static uint8_t occluded[RAYS];
    trace_all_by(renderer, &all);
    for (size_t i = 0; i < RAYS; i++) {
        nears[i] = i % 2 ? 0 : 0.25;
        fars[i] = i % 3 ? INFINITY : all.distances[i] * 0.999;
    }
    ClrtRays rays = rays_given(RAYS);
    const ClrtHits hits = hits_in(&others, 0);
    rays.nears = nears;
    rays.fars = fars;
    assert_true(clrt_trace(renderer, scene, &rays, &hits, NULL));
    assert_true(clrt_occluded(renderer, scene, &rays, occluded, NULL));
    for (size_t i = 0; i < RAYS; i++) {
        const double t = others.distances[i];
        assert_int_equal(occluded[i], others.primitives[i] != CLRT_NOTHING);
        assert_true(t == INFINITY || (t >= nears[i] - 1e-5 && t <= fars[i]));
        if (i % 3 && all.distances[i] > 0.26)
            assert_int_equal(others.primitives[i], all.primitives[i]);
    }
}

TEST(rays_without_finite_numbers_hit_nothing)
{
    enum { BAD = 8 };
    const double bad[BAD][6] = {{NAN, 0, 0, 1, 0, 0},      {0, 0, 0, 0, 0, 0},
                                {0, 0, 0, INFINITY, 0, 0}, {-INFINITY, 0, 0, 1, 0, 0},
                                {0, 0, 0, 1, NAN, 0},      {0, 0, 0, 1, 0.5, 0.25},
                                {0, 0, 0, 1, 0.5, 0.25},   {0, 0, 0, 1, 0.5, 0.25}};
    const double nears[BAD] = {0, 0, 0, 0, 0, NAN, INFINITY, -INFINITY};
    uint32_t primitives[BAD];
    const ClrtRays rays = {.size = sizeof rays,
                           .count = BAD,
                           .origins = bad[0],
                           .directions = bad[0] + 3,
                           .origin_stride = sizeof bad[0],
                           .direction_stride = sizeof bad[0],
                           .nears = nears};
    const ClrtHits hits = {.size = sizeof hits, .primitives = primitives};
    assert_true(clrt_trace(renderer, scene, &rays, &hits, NULL));
    for (int i = 0; i < BAD; i++)
        assert_int_equal(primitives[i], CLRT_NOTHING);
}

static bool stop(void *user, uint64_t done, uint64_t parts)
{
    (void)done, (void)parts;
    ++*(int *)user;
    return false;
}

TEST(progress_stops_large_batches)
{
    int calls = 0;
    const size_t count = 100000; // the size of a part depends on the number of threads
    double *zeros = calloc(count, 3 * sizeof *zeros);
    uint8_t *inside = calloc(count, 1);
    const ClrtRays rays = {
        .size = sizeof rays, .count = count, .origins = zeros, .progress = stop, .user = &calls};
    ClrtError error = faults_blank();
    const bool ok = clrt_contains(renderer, scene, &rays, inside, &error);
    faults_assert(ok, &error, CLRT_STOPPED, "stopped after 1 of ");
    assert_int_equal(calls, 1);
    assert_true(inside[0] && !inside[count - 1]);
    free(zeros);
    free(inside);
}
