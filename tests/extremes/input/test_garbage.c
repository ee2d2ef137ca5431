// SPDX-License-Identifier: MIT
// Vertices of random bits, after Embree's garbage_geom: what is no number is refused, and of the
// rest the triangles that can be seen are drawn right.
#include "support/aim.h"
#include "support/check.h"
#include "support/exact.h"
#include "support/shapes.h"
#include "support/tier.h"
#include "support/trial.h"

#include "mesh/ply.h"

#include <math.h>
#include <string.h>

#define VERTICES  60
#define TRIANGLES 40
#define RAYS      50

static float random_float(Random *random)
{
    const uint32_t bits = (uint32_t)random_bits(random);
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

// A binary mesh; every eighth has coordinates of any bits, the others finite ones.  Indices of
// every 32nd scene are random, too.
static size_t write_mesh(char *bytes, size_t size, bool any_bits, bool any_index, Random *random)
{
    size_t end = (size_t)snprintf(bytes, size,
                                  "ply\nformat binary_little_endian 1.0\nelement vertex %d\n"
                                  "property float x\nproperty float y\nproperty float z\n"
                                  "element face %d\nproperty list uchar int vertex_indices\n"
                                  "end_header\n",
                                  VERTICES, TRIANGLES);
    for (int i = 0; i < 3 * VERTICES; i++) {
        float value = random_float(random);
        while (!any_bits && !(fabsf(value) < 1e29f))
            value = random_float(random);
        memcpy(bytes + end, &value, sizeof value);
        end += sizeof value;
    }
    for (int i = 0; i < TRIANGLES; i++) {
        bytes[end++] = 3;
        for (int corner = 0; corner < 3; corner++) {
            const uint32_t index =
                any_index ? (uint32_t)random_bits(random) : random_below(random, VERTICES);
            memcpy(bytes + end, &index, sizeof index);
            end += sizeof index;
        }
    }
    return end;
}

// Every other corner is brought to about the size of the largest, so that there is something to
// see beside points.
static void enlarge(Mesh *mesh, Random *random)
{
    for (size_t i = 0; i < mesh->vertex_count; i += 2)
        for (int axis = 0; axis < 3; axis++)
            mesh->positions[i][axis] = shape_rounded(random_between(random, -1e29, 1e29));
}

static Fails judge_mesh(RayBatch *batch, Mesh mesh, Random *random)
{
    Stage stage;
    Trial trial;
    Vec3 origin = {0};
    TestRay rays[RAYS];
    Scene scene = shape_scene(mesh);
    stage_make(&stage, &scene, TREE_SAH);
    for (int i = 0; i < RAYS; i++) {
        if (aim_moves_origin((size_t)i, 16))
            origin = random_in_cube(random, 2);
        rays[i] = aim_at(origin, random_in_cube(random, 0.5));
    }
    trial_open(&trial, "T-64", batch, &stage);
    // Embree 3.13.5 ends in a segmentation fault.
    peers_close(&trial.peers);
    const Fails fails =
        trial_fails(&trial, rays, RAYS, &(Judgment){exact_count_wrong, &stage.triangles});
    trial_close(&trial);
    stage_free(&stage);
    scene_free(&scene);
    return fails;
}

static void triangles_of_random_bits_are_refused_or_drawn_right_t64(void **state)
{
    static char bytes[16384];
    char details[64];
    Fails fails = {0};
    Random random = {64};
    size_t refused = 0, judged = 0, silent = 0;
    const size_t scenes = tier_size(50, 1000);
    for (size_t i = 0; i < scenes; i++) {
        Mesh mesh;
        Error error = {0};
        const bool any_bits = i % 8 == 0, any_index = i % 32 == 1;
        const size_t size = write_mesh(bytes, sizeof bytes, any_bits, any_index, &random);
        if (!ply_parse(&mesh, bytes, size, "extremes.ply", &error)) {
            refused++;
            silent += error.text[0] == 0 || !(any_bits || any_index);
            continue;
        }
        if (i % 2 == 0)
            enlarge(&mesh, &random);
        const Fails more = judge_mesh(*state, mesh, &random);
        fails_add(&fails, &more);
        judged++;
    }
    snprintf(details, sizeof details, "scenes=%zu refused=%zu", scenes, refused);
    fails.ours += silent;
    assert_in_range(judged, scenes / 2, scenes);
    assert_int_equal(report_fails("T-64", details, judged * RAYS, &fails), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(triangles_of_random_bits_are_refused_or_drawn_right_t64),
    };
    return cmocka_run_group_tests(tests, ray_batch_setup, ray_batch_teardown);
}
