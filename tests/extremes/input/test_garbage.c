// SPDX-License-Identifier: MIT
// Vertices of random bits, after Embree's garbage_geom. clrt must reject NaN and infinity, and draw
// the triangles of the other meshes right.
#include "support/rig.h"
#include "support/shapes.h"

#include "mesh/ply.h"

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

// Writes a binary mesh and returns its size. Coordinates have any bits or are finite, and indices
// have any bits or are valid.
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

// Every second vertex gets about the largest size, because the others are so small that triangles
// would be points.
static void enlarge(Mesh *mesh, Random *random)
{
    for (size_t i = 0; i < mesh->vertex_count; i += 2)
        shape_set_vertex(mesh, i, random_in_cube(random, 1e29));
}

// Frees the mesh.
static Outcome judge_mesh(RayBatch *batch, Mesh mesh, Random *random)
{
    Vec3 origin = {0};
    TestRay rays[RAYS];
    Rig rig = rig_open("T-64", batch, shape_scene(mesh));
    for (size_t i = 0; i < RAYS; i++) {
        if (rays_move_origin(i, 16))
            origin = random_in_cube(random, 2);
        rays[i] = ray_between(origin, random_in_cube(random, 0.5));
    }
    const Outcome outcome =
        rig_judge(&rig, (Rays){rays, RAYS}, judge_exactly, &rig.stage.triangles);
    rig_close(&rig);
    return outcome;
}

static void triangles_of_random_bits_are_refused_or_drawn_right_t64(void **state)
{
    static char bytes[16384];
    Outcome sum = {0};
    Random random = {64};
    size_t refused = 0, silent = 0;
    const size_t scenes = tier_size(50, 1000);
    unsetenv("CLRT_TEST_PEERS"); // Embree 3.13.5 crashes with a segmentation fault
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
        outcome_add(&sum, judge_mesh(*state, mesh, &random));
    }
    sum.failures[BY_CLRT] += silent;
    outcome_report(sum, "scenes=%zu refused=%zu", scenes, refused);
    assert_in_range(sum.count, scenes / 2 * RAYS, scenes * RAYS);
}

RUN_TESTS(ray_batch_setup, ray_batch_teardown,
          EXTREME(triangles_of_random_bits_are_refused_or_drawn_right_t64))
