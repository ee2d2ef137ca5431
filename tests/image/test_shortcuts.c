// SPDX-License-Identifier: MIT
// Kernels skip boxes, blocks of sky, triangles of a plane and pairs of rays and spheres that cannot
// matter, and some kernels search for scattered rays one by one. If such a shortcut had a fault,
// the picture of a scene below would differ between forms of the kernels or between trees.
#include "image/form.h"
#include "image/rendered.h"
#include "unit/cmocka_all.h"
#include "unit/random.h"

#include <math.h>
#include <unistd.h>

// Draws view 1 of the scene in every form and with every tree, and removes the file.
static void expect_same(const char *scene, uint32_t size)
{
    PictureRequest request = picture_request(scene, 1);
    request.width = request.height = size;
    rendered_expect_same_with_every_tree(request);
    unlink(scene);
}

// Writes a floor, and 25 balls of glass, each of 42 triangles.
static void write_heap(char path[TEMPORARY_PATH])
{
    uint64_t state = 31;
    FILE *stream = temporary_open(path);
    fprintf(stream, "max_level 8\nbackground 0.6 0.7 0.9\ncamera 0.3 -0.2 6  0 0 0  30\n"
                    "light 3 -4 9 0.9\nmaterial 1\nmesh " CLRT_SOURCE_FOLDER
                    "/scenes/plateau.ply scale 3 translate 0 0 -3\n"
                    "define pane glass ior 1.5\nmaterial pane\n");
    for (int i = 0; i < 25; i++) {
        const double x = random_between(&state, -1, 1), y = random_between(&state, -1, 1);
        fprintf(stream,
                "mesh " CLRT_SOURCE_FOLDER "/tests/image/ball.ply scale 0.3 translate %g %g %g\n",
                x, y, random_between(&state, -1, 1));
    }
    temporary_close(stream);
}

// With this many triangles of glass, packets of 8 lanes search for most rays one by one.
TEST(every_form_draws_the_same_heap_of_glass)
{
    char scene[TEMPORARY_PATH];
    write_heap(scene);
    PictureRequest request = picture_request(scene, 1);
    request.width = request.height = 97;
    rendered_expect_same_in_every_form(&request);
    unlink(scene);
}

// Writes a floor from -1 to 1, and a mesh of scraps: triangles within 1e-4 of the center and 2e-7
// of the floor.
#define SCRAPS 100
static void write_floor_and_scraps(char floor[TEMPORARY_PATH], char scraps[TEMPORARY_PATH])
{
    static double corners[][3] = {{-1, -0.93, 0}, {1, -1, 0}, {0.91, 1, 0}, {-0.88, 0.95, 0}};
    static uint32_t halves[][3] = {{0, 1, 2}, {0, 2, 3}};
    double positions[3 * SCRAPS][3];
    uint32_t triangles[SCRAPS][3];
    uint64_t state = 29;
    for (uint32_t i = 0; i < SCRAPS; i++) {
        const double x = random_between(&state, -6e-5, 6e-5);
        const double y = random_between(&state, -6e-5, 6e-5);
        for (uint32_t corner = 3 * i; corner < 3 * i + 3; corner++) {
            triangles[i][corner % 3] = corner;
            positions[corner][0] = x + random_between(&state, -4e-5, 4e-5);
            positions[corner][1] = y + random_between(&state, -4e-5, 4e-5);
            positions[corner][2] = random_between(&state, -2e-7, 2e-7);
        }
    }
    temporary_mesh(
        floor,
        &(Mesh){.positions = corners, .triangles = halves, .vertex_count = 4, .triangle_count = 2});
    temporary_mesh(scraps, &(Mesh){.positions = positions,
                                   .triangles = triangles,
                                   .vertex_count = 3 * SCRAPS,
                                   .triangle_count = SCRAPS});
}

// The errors of the floor's distances exceed the slack of the scraps' boxes. A search must also
// visit boxes that seem to be behind the floor, because their scraps may be nearer.
TEST(boxes_smaller_than_the_errors_of_a_large_triangle_are_not_culled)
{
    char floor[TEMPORARY_PATH], scraps[TEMPORARY_PATH], scene[TEMPORARY_PATH];
    write_floor_and_scraps(floor, scraps);
    FILE *stream = temporary_open(scene);
    fprintf(stream,
            "define floor silhouette diffuse 1 0 0\ndefine scrap silhouette diffuse 0 1 0\n"
            "sides two\ncamera 8e-5 -1e-4 5e-5 0 0 0 60\n"
            "material floor\nply_file %s\nmaterial scrap\nply_file %s\n",
            floor, scraps);
    temporary_close(stream);
    expect_same(scene, 97);
    unlink(floor);
    unlink(scraps);
}

// Writes a floor of many triangles at the height 0.1, and triangular fins that stand on it.
#define TILES_A_SIDE 6
#define FINS         200
static void write_floor_and_fins(char path[TEMPORARY_PATH])
{
    enum { SIDE = TILES_A_SIDE + 1, FLOOR = SIDE * SIDE, HALVES = 2 * TILES_A_SIDE * TILES_A_SIDE };
    static double positions[FLOOR + 3 * FINS][3];
    static uint32_t triangles[HALVES + FINS][3];
    uint64_t state = 3;
    for (uint32_t i = 0; i < FLOOR; i++) {
        positions[i][0] = (i % SIDE + random_between(&state, -0.3, 0.3)) / TILES_A_SIDE - 0.5;
        positions[i][1] = (i / SIDE + random_between(&state, -0.3, 0.3)) / TILES_A_SIDE - 0.5;
        positions[i][2] = 0.1;
    }
    for (uint32_t i = 0; i < HALVES; i++) {
        const uint32_t tile = i / 2, corner = tile / TILES_A_SIDE * SIDE + tile % TILES_A_SIDE;
        triangles[i][0] = corner;
        triangles[i][1] = i % 2 == 0 ? corner + 1 : corner + SIDE + 1;
        triangles[i][2] = i % 2 == 0 ? corner + SIDE + 1 : corner + SIDE;
    }
    for (uint32_t i = 0; i < FINS; i++) {
        const double x = random_between(&state, -0.4, 0.4), y = random_between(&state, -0.4, 0.4);
        for (uint32_t corner = 0; corner < 3; corner++) {
            const uint32_t place = FLOOR + 3 * i + corner;
            positions[place][0] = x + random_between(&state, -0.1, 0.1);
            positions[place][1] = y + random_between(&state, -0.1, 0.1);
            positions[place][2] = corner < 2 ? 0.1 : 0.2;
            triangles[HALVES + i][corner] = place;
        }
    }
    temporary_mesh(path, &(Mesh){.positions = positions,
                                 .triangles = triangles,
                                 .vertex_count = FLOOR + 3 * FINS,
                                 .triangle_count = HALVES + FINS});
}

// A beam whose rays start on triangles of a plane perpendicular to an axis skips all triangles of
// the plane (docs/numerics.md, B16). Each of the three floors is perpendicular to a different axis.
TEST(floors_of_many_triangles_reflect_all_that_stands_on_them)
{
    char mesh[TEMPORARY_PATH], scene[TEMPORARY_PATH];
    write_floor_and_fins(mesh);
    FILE *stream = temporary_open(scene);
    fprintf(stream,
            "define it matte diffuse 0.8 0.7 0.6 kd 0.8 reflectivity 0.5\n"
            "material it\nsides two\nnormals flat\nmax_level 5\n"
            "light 3 4 6 .8\ncamera 1 0.9 1.1  -0.1 -0.1 -0.1  50\n"
            "mesh %s\nmesh %s up x translate -0.6 0 0.6\nmesh %s up y translate 0 -0.6 0.6\n",
            mesh, mesh, mesh);
    temporary_close(stream);
    expect_same(scene, 131);
    unlink(mesh);
}

// Writes a cube, and in every third view a sphere beside it. The eye is inside the cube, or near
// it, or far away.
static void write_view(char path[TEMPORARY_PATH], uint64_t *state, int view)
{
    const double reach = exp(random_between(state, -2, 12));
    const double x = random_between(state, -1, 1), y = random_between(state, -1, 1);
    const double z = random_between(state, -1, 1);
    const double degrees = 1 + fmin(150, 300 / reach) * random_unit(state);
    FILE *stream = temporary_open(path);
    fprintf(stream,
            "define it silhouette diffuse 1 0 0\nmaterial it\nsides two\nply_file %s\n"
            "camera %g %g %g  %g %g %g  %s %g\n",
            CLRT_SOURCE_FOLDER "/scenes/cube.ply", reach * x, reach * y, reach * z, z, x, y,
            view % 4 == 3 ? "orthographic" : "", view % 4 == 3 ? degrees / 5 : degrees);
    if (view % 3 == 0)
        fprintf(stream, "sphere 3 %g 2 1\n", random_between(state, -4, 4));
    temporary_close(stream);
}

// Kernels with wide nodes trace no rays in blocks that are certainly sky (docs/numerics.md, B17).
TEST(no_primitive_is_mistaken_for_sky)
{
    uint64_t random = 17;
    for (int view = 0; view < 32; view++) {
        char scene[TEMPORARY_PATH];
        write_view(scene, &random, view);
        PictureRequest pair = rendered_in_form(picture_request(scene, 1), &form_all[0]);
        pair.width = 97;
        pair.height = 61;
        const PictureRequest wide[] = {rendered_in_form(pair, &form_all[1]),
                                       rendered_in_form(pair, &form_all[2])};
        rendered_expect_same(&pair, wide, 2);
        unlink(scene);
    }
}

// Writes 48 strips of two triangles. Every second strip is 4 roundings lower than the other strips,
// and the scene's last triangle is far below.
#define STRIPS 48
static void write_strips(char path[TEMPORARY_PATH])
{
    static double corners[4 * STRIPS + 3][3];
    static uint32_t triangles[2 * STRIPS + 1][3];
    for (uint32_t i = 0; i < 4 * STRIPS; i++) {
        corners[i][0] = (i / 4 + (i % 4 == 1 || i % 4 == 2)) / (double)STRIPS - 0.5;
        corners[i][1] = i % 4 < 2 ? -0.5 : 0.5;
        corners[i][2] = i / 4 % 2 == 0 ? 1 : 1 - 0x1p-22;
    }
    for (uint32_t i = 0; i < 2 * STRIPS; i++) {
        triangles[i][0] = i / 2 * 4;
        triangles[i][1] = i / 2 * 4 + 1 + i % 2;
        triangles[i][2] = i / 2 * 4 + 2 + i % 2;
    }
    for (uint32_t i = 0; i < 3; i++) {
        corners[4 * STRIPS + i][0] = i / 2.0 - 0.5;
        corners[4 * STRIPS + i][1] = i == 1 ? 0.5 : -0.5;
        corners[4 * STRIPS + i][2] = -0.9;
        triangles[2 * STRIPS][i] = 4 * STRIPS + i;
    }
    temporary_mesh(path, &(Mesh){.positions = corners,
                                 .triangles = triangles,
                                 .vertex_count = 4 * STRIPS + 3,
                                 .triangle_count = 2 * STRIPS + 1});
}

// Rays that leave a level plane skip its triangles. A ray that starts lower, although within
// rounding of the plane, does not skip them: the higher strips shade the lower ones.
TEST(rays_from_just_below_a_level_plane_hit_it)
{
    char mesh[TEMPORARY_PATH], scene[TEMPORARY_PATH];
    write_strips(mesh);
    FILE *stream = temporary_open(scene);
    fprintf(stream,
            "up 0 1 0\ncamera 0 0 2  0 0 1  orthographic 1\nbackground 0 0 0\nambient 0\n"
            "sides two\nsun 1 0 1e-5 8e4\nmaterial 1\nmesh %s\n",
            mesh);
    temporary_close(stream);
    expect_same(scene, 64);
    unlink(mesh);
}

// A ray may be near all 8 spheres of a block. A vector of 4 lanes tests only half of these pairs.
TEST(every_form_draws_nested_spheres)
{
    char scene[TEMPORARY_PATH];
    FILE *stream = temporary_open(scene);
    fprintf(stream, "camera 0 -6 0.5 0 0 0 40\nlight 3 -5 6 .8\nmaterial 3\n");
    for (int i = 0; i < 24; i++)
        fprintf(stream, "sphere %g %g 0 %g\n", 0.01 * (i % 3), 0.01 * (i % 5), 1 + 0.02 * i);
    temporary_close(stream);
    expect_same(scene, 97);
}

// Draws a floor and a ceiling of the same mesh, and a sphere between them.
static void expect_same_room(const char *mesh)
{
    char scene[TEMPORARY_PATH];
    FILE *stream = temporary_open(scene);
    fprintf(stream,
            "define it matte diffuse 0.8 0.7 0.6 kd 0.8 reflectivity 0.5\nmaterial it\nsides two\n"
            "max_level 9\nlight 0.2 0.1 0.7 .8\ncamera 0.9 -1.9 0.3  0 0 0.4  60\n"
            "mesh %s\nmesh %s translate 0 0 1\nsphere 0.1 0.2 0.3 0.2\n",
            mesh, mesh);
    temporary_close(stream);
    expect_same(scene, 97);
    unlink(mesh);
}

// Rays that leave a floor skip its triangles, but no other triangles of the same block.
TEST(a_floor_and_a_ceiling_reflect_each_other)
{
    static double corners[][3] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    static uint32_t halves[][3] = {{0, 1, 2}, {0, 2, 3}};
    char mesh[TEMPORARY_PATH];
    temporary_mesh(
        mesh,
        &(Mesh){.positions = corners, .triangles = halves, .vertex_count = 4, .triangle_count = 2});
    expect_same_room(mesh);
}

// Rays that leave a floor also skip nodes with only its triangles, but no nodes of the ceiling.
TEST(a_floor_and_a_ceiling_of_many_triangles_reflect_each_other)
{
    enum { SIDE = 21, TILES = SIDE - 1 };
    static double corners[SIDE * SIDE][3];
    static uint32_t triangles[2 * TILES * TILES][3];
    char mesh[TEMPORARY_PATH];
    for (uint32_t i = 0; i < SIDE * SIDE; i++) {
        corners[i][0] = 2.0 * (i % SIDE) / TILES - 1;
        corners[i][1] = 2.0 * (i / SIDE) / TILES - 1;
    }
    for (uint32_t i = 0; i < 2 * TILES * TILES; i++) {
        const uint32_t tile = i / 2, corner = tile / TILES * SIDE + tile % TILES;
        triangles[i][0] = corner;
        triangles[i][1] = i % 2 == 0 ? corner + 1 : corner + SIDE + 1;
        triangles[i][2] = i % 2 == 0 ? corner + SIDE + 1 : corner + SIDE;
    }
    temporary_mesh(mesh, &(Mesh){.positions = corners,
                                 .triangles = triangles,
                                 .vertex_count = SIDE * SIDE,
                                 .triangle_count = 2 * TILES * TILES});
    expect_same_room(mesh);
}
