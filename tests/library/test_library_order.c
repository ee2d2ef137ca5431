// SPDX-License-Identifier: MIT
// Shuffles the triangles of closed meshes. Every triangle occurs twice, so every hit is an exact
// tie. A third of the rays go to vertices, and another third go along axes to vertices. At a
// vertex, all triangles around it tie exactly, too.
#include "library/closed_meshes.h"
#include "library/renderer.h"
#include "unit/random.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { RAYS = 4000, COPIES = 2 };

static ClosedMesh mesh;
static Position *positions;
static double origins[RAYS][3], directions[RAYS][3];
static uint64_t numbers = 23;

typedef struct {
    uint32_t *faces;  // face of the mesh at each place of the scene
    uint32_t *places; // places[COPIES * face + copy]
} Order;

typedef struct {
    double distances[RAYS], weights[RAYS][2], normals[RAYS][3];
    uint32_t primitives[RAYS];
} Results;

static Results first, second;

static void open_mesh(int number)
{
    mesh = closed_mesh_make(number);
    positions = closed_mesh_positions(&mesh);
}

static void close_mesh(void)
{
    free(positions);
    closed_mesh_free(&mesh);
}

static void aim(void)
{
    for (size_t i = 0; i < RAYS; i++) {
        const double *vertex = positions[random_below(&numbers, (uint32_t)mesh.vertex_count)];
        const bool is_along_axis = i % 3 == 1;
        const int along = (int)random_below(&numbers, 3);
        for (int axis = 0; axis < 3; axis++) {
            const double aside = i % 3 == 2 ? random_between(&numbers, -0.2, 0.2) : 0;
            const bool is_fixed = is_along_axis && axis != along;
            origins[i][axis] = is_fixed ? vertex[axis] : random_between(&numbers, -1.5, 1.5);
            directions[i][axis] = vertex[axis] + aside - origins[i][axis];
        }
    }
}

// Returns the faces COPIES times, one copy after another, or all shuffled.
static Order order_faces(bool is_shuffled)
{
    const uint32_t count = COPIES * (uint32_t)mesh.face_count;
    const Order order = {calloc(count, sizeof *order.faces), calloc(count, sizeof *order.places)};
    assert_true(order.faces != NULL && order.places != NULL);
    for (uint32_t i = 0; i < count; i++)
        order.faces[i] = i % (uint32_t)mesh.face_count;
    for (uint32_t end = is_shuffled ? count : 0; end > 1; end--) {
        const uint32_t chosen = random_below(&numbers, end), face = order.faces[chosen];
        order.faces[chosen] = order.faces[end - 1];
        order.faces[end - 1] = face;
    }
    uint32_t *copies = calloc(mesh.face_count, sizeof *copies);
    assert_non_null(copies);
    for (uint32_t i = 0; i < count; i++)
        order.places[COPIES * order.faces[i] + copies[order.faces[i]]++] = i;
    free(copies);
    return order;
}

static void order_free(Order order)
{
    free(order.faces);
    free(order.places);
}

static void trace(Order order, Results *results)
{
    const size_t count = COPIES * mesh.face_count;
    uint32_t(*faces)[3] = calloc(count, sizeof *faces);
    assert_non_null(faces);
    for (size_t i = 0; i < count; i++)
        memcpy(faces[i], mesh.faces[order.faces[i]], sizeof *faces);
    const ClrtMesh given = {.size = sizeof given,
                            .positions = positions[0],
                            .triangles = faces[0],
                            .vertex_count = mesh.vertex_count,
                            .triangle_count = count};
    const ClrtRays rays = {
        .size = sizeof rays, .count = RAYS, .origins = origins[0], .directions = directions[0]};
    const ClrtHits hits = {.size = sizeof hits,
                           .distances = results->distances,
                           .primitives = results->primitives,
                           .weights = results->weights[0],
                           .normals = results->normals[0]};
    ClrtScene *scene = clrt_scene_create(NULL);
    assert_true(clrt_scene_add_mesh(scene, &given, NULL));
    assert_true(clrt_trace(renderer, scene, &rays, &hits, NULL));
    clrt_scene_free(scene);
    free(faces);
}

// Returns whether no copy of the face has a lower index than the primitive.
static bool is_lowest(Order order, uint32_t primitive, uint32_t face)
{
    for (int copy = 0; copy < COPIES; copy++)
        if (order.places[COPIES * face + (uint32_t)copy] < primitive)
            return false;
    return true;
}

// Returns the number of rays whose hit face depends on the order. The distances must be equal.
static size_t compare(Order order, Order shuffled)
{
    size_t ties = 0;
    for (size_t i = 0; i < RAYS; i++) {
        if (first.primitives[i] == CLRT_NOTHING || second.primitives[i] == CLRT_NOTHING) {
            assert_int_equal(first.primitives[i], second.primitives[i]);
            continue;
        }
        const uint32_t face = order.faces[first.primitives[i]];
        const uint32_t other = shuffled.faces[second.primitives[i]];
        assert_true(is_lowest(order, first.primitives[i], face));
        assert_true(is_lowest(order, first.primitives[i], other));
        assert_true(is_lowest(shuffled, second.primitives[i], other));
        assert_true(is_lowest(shuffled, second.primitives[i], face));
        assert_memory_equal(&second.distances[i], &first.distances[i], sizeof first.distances[i]);
        if (face != other) {
            ties++;
            continue;
        }
        assert_memory_equal(second.weights[i], first.weights[i], sizeof first.weights[i]);
        assert_memory_equal(second.normals[i], first.normals[i], sizeof first.normals[i]);
    }
    return ties;
}

TEST(the_order_of_triangles_changes_no_bit_but_decides_which_face_of_a_tie_is_hit)
{
    size_t ties = 0;
    for (int number = 0; number < CLOSED_MESHES; number++) {
        open_mesh(number);
        aim();
        const Order order = order_faces(false), shuffled = order_faces(true);
        trace(order, &first);
        trace(shuffled, &second);
        ties += compare(order, shuffled);
        order_free(order);
        order_free(shuffled);
        close_mesh();
    }
    print_message("%zu ties of neighbors\n", ties);
    assert_true(ties > 0);
}
