// SPDX-License-Identifier: MIT
// A checker divides space into cubes. Tests that a flat floor shows one layer of cubes, in every
// form of the kernels. The expected picture is computed from known hit points of orthographic rays.
#include "image/form.h"
#include "image/rendered.h"
#include "unit/cmocka_all.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

// The centers of the middle column and row are exactly on lines between checks.
#define SIDE 65
#define VIEW 4.0

// A square floor perpendicular to an axis. Its two triangles face opposite sides. Two of its
// corners are higher by `bend`, and two are lower. A triangle outside the picture moves the center
// of normalized coordinates away from the floor, because near the center rounding would not show.
typedef struct {
    double size; // of a cube
    int axis;
    double height, bend;
    bool from_below;
} Floor;

static void write_floor(const Floor *floor, char path[TEMPORARY_PATH])
{
    static const double places[7][2] = {{-3.1, -3.2}, {2.9, -3.2}, {2.9, 2.8}, {-3.1, 2.8},
                                        {2.5, 2.4},   {2.8, 2.4},  {2.8, 2.7}};
    uint32_t triangles[3][3] = {{0, 1, 2}, {0, 3, 2}, {4, 5, 6}};
    double positions[7][3];
    for (int corner = 0; corner < 7; corner++) {
        const double bend = corner < 2 ? floor->bend : -floor->bend;
        positions[corner][floor->axis] = floor->height + (corner < 4 ? bend : 1.3);
        positions[corner][(floor->axis + 1) % 3] = places[corner][0];
        positions[corner][(floor->axis + 2) % 3] = places[corner][1];
    }
    temporary_mesh(path, &(Mesh){.positions = positions,
                                 .triangles = triangles,
                                 .vertex_count = 7,
                                 .triangle_count = 3});
}

static void write_scene(const Floor *floor, const char *mesh, char path[TEMPORARY_PATH])
{
    double eye[3] = {0, 0, 0}, up[3] = {0, 0, 0};
    FILE *scene = temporary_open(path);
    eye[floor->axis] = floor->height + (floor->from_below ? -9 : 9);
    up[(floor->axis + 2) % 3] = 1;
    fprintf(scene, "define a silhouette checker %.9g 1 1 1 0 0 0\nmaterial a\nsides two\n",
            floor->size);
    fprintf(scene, "ply_file %s\nup %g %g %g\ncamera %.17g %.17g %.17g 0 0 0 orthographic %g\n",
            mesh, up[0], up[1], up[2], eye[0], eye[1], eye[2], VIEW);
    temporary_close(scene);
}

// Returns the number of the cube at a coordinate. A line between cubes belongs to the cube with the
// higher number.
static long cube_of(double coordinate, double size)
{
    return lround(floor(coordinate / (double)(float)size + 1e-6));
}

// Returns whether the floor's square at a pixel is odd. Seen from above, the axis after the floor's
// points right in the picture, and the third axis points up.
static bool square_is_odd(const Floor *floor, int column, int row)
{
    const double across = (column - SIDE / 2) * VIEW / SIDE, down = (row - SIDE / 2) * VIEW / SIDE;
    const double right = floor->from_below ? -across : across;
    return ((cube_of(right, floor->size) + cube_of(-down, floor->size)) & 1) != 0;
}

// Returns whether the floor shows an odd layer of cubes. Fails if the pixels disagree.
static bool layer_is_odd(const Floor *floor, const KernelChoice *form)
{
    char mesh[TEMPORARY_PATH], path[TEMPORARY_PATH];
    write_floor(floor, mesh);
    write_scene(floor, mesh, path);
    PictureRequest request = picture_request(path, 1);
    request.width = request.height = SIDE;
    request = rendered_in_form(request, form);
    FREED_BY(framebuffer_free) Framebuffer picture = rendered(&request);
    int odd = 0;
    for (int pixel = 0; pixel < SIDE * SIDE; pixel++) {
        const bool is_black = picture.pixels[pixel][0] < 0.5f;
        odd += is_black != square_is_odd(floor, pixel % SIDE, pixel / SIDE);
    }
    if (odd != 0 && odd != SIDE * SIDE)
        fail_msg("size %g, axis %d, height %.17g, bend %g, %s: %d of %d pixels are odd",
                 floor->size, floor->axis, floor->height, floor->bend,
                 floor->from_below ? "below" : "above", odd, SIDE * SIDE);
    remove(path);
    remove(mesh);
    return odd != 0;
}

// A floor exactly between two layers shows the layer behind it, even if rounding puts some of the
// floor's corners into the layer in front of it.
TEST(a_floor_between_layers_shows_the_layer_behind_it)
{
    static const double sizes[] = {0.5, 0.3}, bends[] = {0, 1e-9, -1e-13};
    for (int i = 0; i < 36; i++) {
        const int layer = i % 5 - 2;
        const double size = sizes[i % 2];
        const Floor floor = {size, i % 3, layer * size, bends[i / 2 % 3], i / 6 % 2 != 0};
        const int behind = floor.from_below ? layer : layer - 1;
        assert_int_equal(layer_is_odd(&floor, &form_all[i % FORMS]), behind & 1);
    }
}

// At these heights, place_move (docs/numerics.md, B19) moves the coordinate to the plane between
// two layers.
TEST(no_floor_flickers_at_any_height)
{
    const double rate = 8, move = 0x1p-19 * (rate + 1); // normalization divides by 4
    // A step is about a unit in the last place of the floor's normalized coordinate.
    for (int i = -8; i <= 8; i++) {
        const Floor floor = {0.5, 2, 0.5 * (2 + move * (1 + i * 0x1p-7)), 0, false};
        layer_is_odd(&floor, &form_all[(i + 8) % FORMS]);
    }
}
