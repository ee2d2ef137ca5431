// SPDX-License-Identifier: MIT
// Tests which pixels thin parts touch, and where they request samples, even if the parts are many
// or hard to project.
#include "mesh/mesh_pieces.h"
#include "refine/thin_parts.h"
#include "scene/camera.h"
#include "unit/cmocka_all.h"
#include "unit/random.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SIDE  120
#define FOCUS 100.0 // the side of a pixel is 1 / FOCUS at distance 1
#define PI    3.14159265358979

// A mesh and its view. The eye is at the origin and looks along y, with z up. A point appears FOCUS
// * x / y pixels to the right of the center.
typedef struct {
    double (*positions)[3];
    uint32_t (*triangles)[3];
    MeshObject object;
    Scene scene;
    Normalization normalization;
    FrameData frame;
    double height; // height of an orthographic picture; 0 for perspective
    SphereData sphere;
    ThinParts parts;
} World;

static World world_of(size_t triangles)
{
    World world = {.positions = calloc(3 * triangles, sizeof *world.positions),
                   .triangles = calloc(triangles, sizeof *world.triangles)};
    assert_true(world.positions != NULL && world.triangles != NULL);
    return world;
}

static void add_triangle(World *world, Vec3 a, Vec3 b, Vec3 c)
{
    const Vec3 corners[3] = {a, b, c};
    Mesh *mesh = &world->object.mesh;
    for (int i = 0; i < 3; i++) {
        double *position = world->positions[mesh->vertex_count];
        position[0] = corners[i].x;
        position[1] = corners[i].y;
        position[2] = corners[i].z;
        world->triangles[mesh->triangle_count][i] = (uint32_t)mesh->vertex_count++;
    }
    mesh->triangle_count++;
}

static void search(World *world, uint32_t threads)
{
    const Viewpoint viewpoint = {.look_at = {0, 1, 0},
                                 .up = {0, 0, 1},
                                 .fov_degrees = 2 * atan(SIDE / 2 / FOCUS) * 180 / PI,
                                 .height = world->height};
    world->object.mesh.positions = world->positions;
    world->object.mesh.triangles = world->triangles;
    world->scene.objects.data = &world->object;
    world->scene.objects.count = 1;
    world->normalization = normalization_of(&world->scene);
    world->frame = (FrameData){.width = SIDE,
                               .height = SIDE,
                               .samples = REFINE_GRID,
                               .max_level = 1,
                               .sphere_count = world->sphere.radius > 0};
    world->frame.camera = camera_make(&viewpoint, &world->normalization, SIDE, SIDE, REFINE_GRID);
    ThreadPool *pool = thread_pool_open(threads);
    Error error;
    FREED_BY(mesh_pieces_free) MeshPieces pieces;
    assert_true(mesh_pieces_make(&pieces, &world->object.mesh, &error));
    const FlatScene flat = {.spheres = &world->sphere};
    const RefineSetup setup = {.flat = &flat,
                               .pool = pool,
                               .scene = &world->scene,
                               .pieces = &pieces,
                               .normalization = &world->normalization};
    assert_true(thin_parts_make(&world->parts, &setup, &world->frame, true, &error));
    thread_pool_close(pool);
}

static void close_world(World *world)
{
    thin_parts_free(&world->parts);
    free(world->positions);
    free(world->triangles);
}

// Returns whether a thin part touches the pixel.
static bool is_touched(const World *world, uint32_t column, uint32_t row)
{
    return world->parts.axes[row * SIDE + column] != THIN_NONE;
}

static uint64_t count_touched(const World *world)
{
    uint64_t count = 0;
    for (uint32_t pixel = 0; pixel < SIDE * SIDE; pixel++)
        count += world->parts.axes[pixel] != THIN_NONE;
    assert_int_equal(count, world->parts.touched);
    return count;
}

// Returns the number of probes in a rectangle. The corners are in pixels.
static size_t probes_in(const World *world, double left, double top, double right, double bottom)
{
    size_t count = 0;
    for (size_t i = 0; i < world->parts.probes.count; i++) {
        const Probe *probe = &world->parts.probes.data[i];
        const bool has_rows = world->parts.axes[probe->pixel] == THIN_ROWS;
        const double along = (probe->place + 0.5) / REFINE_GRID;
        const double across = (probe->line + 0.5) / REFINE_GRID;
        const double x = probe->pixel % SIDE + (has_rows ? along : across);
        const double y = probe->pixel / SIDE + (has_rows ? across : along);
        count += x >= left && x <= right && y >= top && y <= bottom;
    }
    return count;
}

static uint64_t pixels_of_triangle(Vec3 a, Vec3 b, Vec3 c, bool two_sided)
{
    FREED_BY(close_world) World world = world_of(1);
    world.object.two_sided = two_sided;
    add_triangle(&world, a, b, c);
    search(&world, 1);
    const uint64_t count = count_touched(&world);
    return count;
}

// Returns the point at this depth that appears at (x, y), in pixels from the upper left corner.
static Vec3 point_at(double x, double y, double depth)
{
    return vec3((x - SIDE / 2.0) / FOCUS * depth, depth, (SIDE / 2.0 - y) / FOCUS * depth);
}

TEST(a_small_triangle_has_probes_where_it_appears)
{
    FREED_BY(close_world) World world = world_of(1);
    add_triangle(&world, point_at(40.1, 70.9, 5), point_at(40.4, 70.8, 6), point_at(40.3, 70.7, 7));
    search(&world, 1);
    assert_true(is_touched(&world, 40, 70));
    assert_int_equal(count_touched(&world), 1);
    assert_true(probes_in(&world, 40.1, 70.7, 40.4, 70.9) > 0);
    assert_int_equal(probes_in(&world, 40.0, 70.6, 40.5, 71.0), world.parts.probes.count);
}

// The position in an orthographic picture does not depend on the depth.
TEST(small_parts_of_orthographic_pictures_have_probes_where_they_appear)
{
    FREED_BY(close_world) World world = world_of(1);
    world.height = SIDE;
    add_triangle(&world, vec3(40.1 - SIDE / 2, 5, SIDE / 2 - 70.9),
                 vec3(40.4 - SIDE / 2, 60, SIDE / 2 - 70.8),
                 vec3(40.3 - SIDE / 2, 700, SIDE / 2 - 70.7));
    search(&world, 1);
    assert_true(is_touched(&world, 40, 70));
    assert_int_equal(count_touched(&world), 1);
    assert_true(probes_in(&world, 40.1, 70.7, 40.4, 70.9) > 0);
}

TEST(small_spheres_of_orthographic_pictures_have_probes_where_they_appear)
{
    FREED_BY(close_world) World world = world_of(1);
    world.height = 1;
    world.sphere =
        (SphereData){.center = {(40.5f - SIDE / 2) / SIDE, 0.9f, (SIDE / 2 - 70.5f) / SIDE},
                     .radius = 0.1f / SIDE};
    search(&world, 1);
    assert_true(is_touched(&world, 40, 70));
    assert_int_equal(count_touched(&world), 1);
    assert_true(probes_in(&world, 40.4, 70.4, 40.6, 70.6) > 1);
}

TEST(a_triangle_is_thin_from_either_side_only_if_it_has_two)
{
    const Vec3 a = point_at(40.1, 70.9, 5), b = point_at(40.4, 70.8, 6),
               c = point_at(40.3, 70.7, 7);
    assert_int_equal(pixels_of_triangle(a, b, c, false), 1);
    assert_int_equal(pixels_of_triangle(a, c, b, false), 0);
    assert_int_equal(pixels_of_triangle(a, c, b, true), 1);
}

TEST(triangles_edge_on_behind_or_beside_touch_no_pixels)
{
    assert_int_equal(pixels_of_triangle(vec3(0, 5, 0), vec3(0, 9, 0), vec3(0, 7, 1e-300), true), 0);
    assert_int_equal(pixels_of_triangle(vec3(0, -5, 0), vec3(0.01, -5, 0), vec3(0, -5, 0.01), true),
                     0);
    assert_int_equal(pixels_of_triangle(vec3(9, 5, 0), vec3(9.01, 5, 0), vec3(9, 5, 0.01), true),
                     0);
    assert_int_equal(pixels_of_triangle(vec3(0, 0, 0), vec3(0, 0, 0), vec3(0, 0, 0), true), 0);
}

// The sliver is below the eye and starts behind it, so it appears from the picture's lower edge
// upward.
TEST(a_sliver_through_the_plane_of_the_eye_touches_pixels_in_front_of_the_eye)
{
    const double side = 0.5 / FOCUS, far = 1000, end = 1 / ((70.5 - SIDE / 2.0) / FOCUS);
    FREED_BY(close_world) World world = world_of(2);
    add_triangle(&world, vec3(side, -far, -1), vec3(side * 1.01, -far, -1), vec3(side, end, -1));
    search(&world, 1);
    for (uint32_t row = 0; row < SIDE; row++) {
        bool touched = false;
        for (uint32_t column = 0; column < SIDE; column++)
            touched = touched || is_touched(&world, column, row);
        assert_int_equal(touched, row >= 70);
    }
}

TEST(a_sliver_of_a_thousand_scenes_length_has_probes_in_the_picture)
{
    FREED_BY(close_world) World world = world_of(1);
    add_triangle(&world, vec3(0.005, 1, -1e9), vec3(0.006, 1, -1e9), vec3(0.0055, 1, 1e9));
    search(&world, 1);
    for (uint32_t row = 0; row < SIDE; row++) {
        assert_true(is_touched(&world, 60, row));
        assert_true(probes_in(&world, 60.4, row, 60.7, row + 1) >= 3);
    }
    assert_int_equal(count_touched(&world), SIDE);
}

// Adds slivers across the picture in all directions.
static void add_slivers(World *world, int count, double thickness)
{
    uint64_t random = 1;
    for (int i = 0; i < count; i++) {
        const double angle = PI * random_unit(&random);
        const double offset = SIDE * (random_unit(&random) - 0.5);
        const double x = cos(angle), y = sin(angle), far = 2 * SIDE;
        const double middle[2] = {SIDE / 2.0 - offset * y, SIDE / 2.0 + offset * x};
        add_triangle(
            world, point_at(middle[0] - far * x, middle[1] - far * y, 3),
            point_at(middle[0] + far * x + thickness * y, middle[1] + far * y - thickness * x, 3),
            point_at(middle[0] + far * x, middle[1] + far * y, 3));
    }
}

TEST(too_many_slivers_request_no_more_samples_than_there_are)
{
    FREED_BY(close_world) World world = world_of(4000);
    world.object.two_sided = true;
    add_slivers(&world, 4000, 0.001);
    search(&world, 2);
    assert_true(100 * count_touched(&world) > 99 * SIDE * SIDE);
    assert_true(world.parts.probes.count <= (size_t)THIN_SAMPLES * SIDE * SIDE);
}

static int compare_probes(const void *a, const void *b)
{
    const Probe *one = a, *other = b;
    const uint64_t keys[2] = {
        (((uint64_t)one->pixel * 256 + one->line) * 256 + one->place) * 256 + one->level,
        (((uint64_t)other->pixel * 256 + other->line) * 256 + other->place) * 256 + other->level};
    return (keys[0] > keys[1]) - (keys[0] < keys[1]);
}

TEST(any_threads_find_the_same_places)
{
    World worlds[4];
    for (uint32_t i = 0; i < 4; i++) {
        worlds[i] = world_of(5000);
        worlds[i].object.two_sided = true;
        add_slivers(&worlds[i], 10, 0.3);
        search(&worlds[i], i + 1);
        qsort(worlds[i].parts.probes.data, worlds[i].parts.probes.count, sizeof(Probe),
              compare_probes);
    }
    assert_true(worlds[0].parts.probes.count > SIDE);
    for (int i = 1; i < 4; i++) {
        assert_memory_equal(worlds[i].parts.axes, worlds[0].parts.axes, SIDE * SIDE);
        assert_int_equal(worlds[i].parts.probes.count, worlds[0].parts.probes.count);
        for (size_t k = 0; k < worlds[0].parts.probes.count; k++)
            assert_int_equal(
                compare_probes(&worlds[i].parts.probes.data[k], &worlds[0].parts.probes.data[k]),
                0);
    }
    for (int i = 0; i < 4; i++)
        close_world(&worlds[i]);
}

// Adds two adjacent triangles that share no vertex.
static void add_strip(World *world, double left, double right)
{
    add_triangle(world, point_at(left, 10.1, 4), point_at(left, 109.9, 4),
                 point_at(right, 109.9, 4));
    add_triangle(world, point_at(left, 10.1, 4), point_at(right, 109.9, 4),
                 point_at(right, 10.1, 4));
}

TEST(a_wide_part_made_of_thin_ones_touches_no_pixels)
{
    FREED_BY(close_world) World world = world_of(400);
    for (int i = 0; i < 200; i++)
        add_strip(&world, 50 + 0.1 * i, 50 + 0.1 * (i + 1));
    search(&world, 1);
    assert_int_equal(count_touched(&world), 0);
}

// Adds a square of small triangles that covers about 6 x 6 pixels.
static void add_square(World *world)
{
    for (int i = 0; i < 25; i++) {
        const double left = 40.1 + 1.16 * (i % 5), top = 70.1 + 1.16 * (i / 5);
        const double right = left + 1.16, bottom = top + 1.16;
        add_triangle(world, point_at(left, top, 4), point_at(left, bottom, 4),
                     point_at(right, bottom, 4));
        add_triangle(world, point_at(left, top, 4), point_at(right, bottom, 4),
                     point_at(right, top, 4));
    }
}

TEST(a_small_triangle_is_found_before_and_after_a_wide_part_of_the_same_piece)
{
    for (int is_last = 0; is_last < 2; is_last++) {
        FREED_BY(close_world) World world = world_of(51);
        if (is_last)
            add_square(&world);
        add_triangle(&world, point_at(100.1, 20.9, 4), point_at(100.4, 20.8, 4),
                     point_at(100.3, 20.7, 4));
        if (!is_last)
            add_square(&world);
        search(&world, 1);
        assert_true(is_touched(&world, 100, 20));
        assert_int_equal(count_touched(&world), 1);
    }
}

// Adds a strip of triangles that form one piece of the mesh.
static void add_joined_strip(World *world, double left, double right)
{
    Mesh *mesh = &world->object.mesh;
    const uint32_t first = (uint32_t)mesh->vertex_count;
    for (uint32_t i = 0; i <= PIECE_TRIANGLES / 2; i++) {
        const double y = 10.1 + 99.8 * i / (PIECE_TRIANGLES / 2);
        const Vec3 ends[2] = {point_at(left, y, 4), point_at(right, y, 4)};
        for (int k = 0; k < 2; k++) {
            double *position = world->positions[mesh->vertex_count++];
            position[0] = ends[k].x;
            position[1] = ends[k].y;
            position[2] = ends[k].z;
        }
    }
    for (uint32_t i = 0; i < PIECE_TRIANGLES; i++) {
        const uint32_t corner = first + i / 2 * 2, odd = i % 2;
        const uint32_t corners[3] = {corner, corner + 2 + odd, corner + 3 - 2 * odd};
        memcpy(world->triangles[mesh->triangle_count++], corners, sizeof corners);
    }
}

TEST(a_thin_piece_is_found_before_a_wide_one_of_the_same_mesh)
{
    FREED_BY(close_world) World world = world_of(2 * PIECE_TRIANGLES);
    add_joined_strip(&world, 20, 90);
    add_joined_strip(&world, 50.2, 50.5);
    search(&world, 1);
    for (uint32_t row = 0; row < SIDE; row++)
        assert_int_equal(is_touched(&world, 50, row), row >= 10 && row < 110);
}

// Both strips cover the tested pixels. The search starts with the broader strip.
TEST(a_thin_piece_has_probes_before_a_broader_one_of_the_same_pixels)
{
    FREED_BY(close_world) World world = world_of(2 * PIECE_TRIANGLES);
    add_joined_strip(&world, 50.05, 50.95);
    add_joined_strip(&world, 50.45, 50.55);
    search(&world, 1);
    for (uint32_t row = 30; row < 90; row++)
        for (uint32_t third = 0; third < 3; third++)
            assert_true(
                probes_in(&world, 50.45, row + third / 3.0, 50.55, row + (third + 1) / 3.0) >= 2);
}

// Like a tube of slivers, which together are as broad as a third of a pixel.
TEST(slivers_of_one_piece_request_no_more_samples_than_their_union)
{
    FREED_BY(close_world) World world = world_of(400);
    for (int i = 0; i < 100; i++)
        add_strip(&world, 50.3 + 0.003 * i, 50.3 + 0.003 * (i + 1));
    search(&world, 1);
    for (uint32_t row = 30; row < 90; row++)
        for (uint32_t third = 0; third < 3; third++) {
            assert_true(probes_in(&world, 50.3, row + third / 3.0, 50.6, row + (third + 1) / 3.0) >=
                        2);
            assert_true(probes_in(&world, 50, row + third / 3.0, 51, row + (third + 1) / 3.0) <=
                        16);
        }
}
