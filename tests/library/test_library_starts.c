// SPDX-License-Identifier: MIT
// Two triangles share a vertex, and each crosses the plane of the other. Rays start on one
// triangle, so close to the vertex that rounding puts the start on both planes. Then only the order
// of the triangles along the ray decides whether the ray hits the other triangle (docs/numerics.md,
// "Closed mirrors", step 5).
//
// fp64 is not tested, because rays would have to start within a tiny distance of the vertex. The
// library moves starts onto their triangle, and the error of this move is larger than the distance.
#include "unit/cmocka_all.h"
#include "unit/random.h"

#include <clrt.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PAIRS = 50, RAYS = 40, VERTICES = 12 };

// Heights over the plane z = 0 are slopes[triangle][0] * x + slopes[triangle][1] * y.
typedef struct {
    double slopes[2][2]; // [0]: the triangle that rays start on, [1]: the other triangle
    double bearing;      // from the vertex, along the line in which the triangles cross
    double positions[VERTICES][3];
} Pair;

typedef struct {
    double origins[RAYS][3], directions[RAYS][3];
    double ahead[RAYS]; // distance to the other triangle along the ray
} Aimed;

static uint64_t numbers = 45;

static double height(const Pair *pair, int triangle, double x, double y)
{
    return pair->slopes[triangle][0] * x + pair->slopes[triangle][1] * y;
}

static void set_corner(Pair *pair, int triangle, int corner, double turn)
{
    const double reach = random_between(&numbers, 0.4, 0.6);
    double *position = pair->positions[3 * triangle + corner];
    position[0] = reach * cos(pair->bearing + turn);
    position[1] = reach * sin(pair->bearing + turn);
    position[2] = height(pair, triangle, position[0], position[1]);
}

// The vertex is at the origin. Two small triangles make the vertex the center of the scene, so that
// normalization does not round coordinates close to the vertex.
static Pair random_pair(void)
{
    static const double far[6][3] = {{1, 1, 1},    {1, 0.99, 1},    {0.99, 1, 1},
                                     {-1, -1, -1}, {-1, -0.99, -1}, {-0.99, -1, -1}};
    Pair pair = {.bearing = random_between(&numbers, 0, 6.28)};
    const double crossing = random_between(&numbers, 0.3, 1);
    const double across[2] = {-sin(pair.bearing) * crossing, cos(pair.bearing) * crossing};
    for (int axis = 0; axis < 2; axis++) {
        pair.slopes[0][axis] = random_between(&numbers, -1, 1);
        pair.slopes[1][axis] = pair.slopes[0][axis] + across[axis];
    }
    for (int triangle = 0; triangle < 2; triangle++) {
        set_corner(&pair, triangle, 0, random_between(&numbers, -0.5, -0.2));
        set_corner(&pair, triangle, 1, random_between(&numbers, 0.2, 0.5));
    }
    memcpy(pair.positions[6], far, sizeof far);
    return pair;
}

// Omits rays where the triangles are so close to each other that rounding their corners could swap
// them.
static Aimed aim(const Pair *pair)
{
    const double least = 1e-4;
    Aimed aimed = {0};
    for (int i = 0; i < RAYS;) {
        const double away = pow(10, random_between(&numbers, -8, -5.5));
        const double bearing = pair->bearing + random_between(&numbers, -0.19, 0.19);
        const double x = (double)(float)(away * cos(bearing));
        const double y = (double)(float)(away * sin(bearing));
        const double start = height(pair, 0, x, y), up = random_below(&numbers, 2) == 0 ? 1 : -1;
        const double ahead = up * (height(pair, 1, x, y) - start);
        if (fabs(ahead) < least * away)
            continue;
        memcpy(aimed.origins[i], (double[]){x, y, start}, sizeof aimed.origins[i]);
        aimed.directions[i][2] = up;
        aimed.ahead[i++] = ahead;
    }
    return aimed;
}

static ClrtScene *scene_of(const Pair *pair)
{
    static const uint32_t faces[4][3] = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}};
    const ClrtMesh mesh = {.size = sizeof mesh,
                           .positions = pair->positions[0],
                           .triangles = faces[0],
                           .vertex_count = VERTICES,
                           .triangle_count = 4};
    ClrtScene *scene = clrt_scene_create(NULL);
    assert_true(scene != NULL && clrt_scene_add_mesh(scene, &mesh, NULL));
    return scene;
}

static int count_wrong(ClrtRenderer *renderer, const Pair *pair)
{
    static const uint32_t starts[RAYS]; // all on triangle 0
    uint32_t primitives[RAYS];
    const Aimed aimed = aim(pair);
    const ClrtRays rays = {.size = sizeof rays,
                           .count = RAYS,
                           .origins = aimed.origins[0],
                           .directions = aimed.directions[0],
                           .starts = starts};
    const ClrtHits hits = {.size = sizeof hits, .primitives = primitives};
    ClrtScene *scene = scene_of(pair);
    int wrong = 0;
    assert_true(clrt_trace(renderer, scene, &rays, &hits, NULL));
    clrt_scene_free(scene);
    for (int i = 0; i < RAYS; i++)
        wrong += (primitives[i] == 1) != (aimed.ahead[i] > 0);
    return wrong;
}

static ClrtRenderer *open_renderer(ClrtKernel kernel)
{
    const ClrtSettings settings = {
        .size = sizeof settings, .device = getenv("CLRT_DEVICE"), .kernel = kernel};
    ClrtRenderer *renderer = clrt_renderer_create(&settings, NULL);
    assert_non_null(renderer);
    return renderer;
}

static void expect_none_wrong(ClrtKernel kernel)
{
    ClrtRenderer *renderer = open_renderer(kernel);
    int wrong = 0;
    for (int i = 0; i < PAIRS; i++) {
        const Pair pair = random_pair();
        wrong += count_wrong(renderer, &pair);
    }
    clrt_renderer_free(renderer);
    assert_int_equal(wrong, 0);
}

TEST(rays_that_start_beside_a_vertex_hit_the_triangles_ahead_and_no_others)
{
    expect_none_wrong(CLRT_KERNEL_AUTO); // packets, except on GPUs
    expect_none_wrong(CLRT_KERNEL_WIDE);
    expect_none_wrong(CLRT_KERNEL_PAIR);
}

TEST(rays_that_start_on_triangles_mix_with_other_rays)
{
    uint32_t starts[RAYS], primitives[RAYS], alone = 0;
    double distances[RAYS], distance = 0;
    ClrtRenderer *renderer = open_renderer(CLRT_KERNEL_AUTO);
    const Pair pair = random_pair();
    const Aimed aimed = aim(&pair);
    ClrtScene *scene = scene_of(&pair);
    for (uint32_t i = 0; i < RAYS; i++)
        starts[i] = i % 3 == 0 ? CLRT_NOTHING : 0;
    ClrtRays rays = {.size = sizeof rays,
                     .count = RAYS,
                     .origins = aimed.origins[0],
                     .directions = aimed.directions[0],
                     .starts = starts};
    const ClrtHits mixed = {.size = sizeof mixed, .distances = distances, .primitives = primitives};
    const ClrtHits single = {.size = sizeof single, .distances = &distance, .primitives = &alone};
    assert_true(clrt_trace(renderer, scene, &rays, &mixed, NULL));
    rays.count = 1;
    for (size_t i = 0; i < RAYS; i++) {
        rays.origins = aimed.origins[i];
        rays.directions = aimed.directions[i];
        rays.starts = &starts[i];
        assert_true(clrt_trace(renderer, scene, &rays, &single, NULL));
        assert_int_equal(primitives[i], alone);
        assert_true(distances[i] == distance);
    }
    clrt_scene_free(scene);
    clrt_renderer_free(renderer);
}
