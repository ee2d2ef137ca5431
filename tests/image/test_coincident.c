// SPDX-License-Identifier: MIT
// Tests that the triangle with the lowest id wins among coincident triangles. This must hold for
// every order of corners and in every form of the kernels. A copy of a mesh at the same place must
// not change a bit.
#include "image/form.h"
#include "image/rendered.h"
#include "image/temporary.h"
#include "unit/cmocka_all.h"

#include <math.h>
#include <unistd.h>

#define ORDERS 6
#define PAIRS  (ORDERS * ORDERS)
#define SIDE   181

static const KernelChoice forms[] = {
    {FAMILY_RAY, NODES_PAIR, 0, PRECISION_FP32},     {FAMILY_RAY, NODES_WIDE, 0, PRECISION_FP32},
    {FAMILY_PACKET, NODES_WIDE, 16, PRECISION_FP32}, {FAMILY_PACKET, NODES_WIDE, 8, PRECISION_FP32},
    {FAMILY_PACKET, NODES_WIDE, 4, PRECISION_FP32},  {FAMILY_RAY, NODES_PAIR, 0, PRECISION_FP64}};
#define FORMS (sizeof forms / sizeof *forms)

// The first three orders keep the front side, and the others reverse it.
static const int orders[ORDERS][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1},
                                      {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};

static bool is_reversed(int order)
{
    return order >= 3;
}

static double random_between(uint32_t *state, double low, double high)
{
    *state = *state * 1664525 + 1013904223;
    return low + (high - low) * (*state >> 8) / 0x1p24;
}

static void write_head(FILE *stream, int vertices, int faces, bool has_normals)
{
    fprintf(stream,
            "ply\nformat ascii 1.0\nelement vertex %d\nproperty double x\nproperty double y\n"
            "property double z\n%selement face %d\nproperty list uchar int vertex_indices\n"
            "end_header\n",
            vertices,
            has_normals ? "property float nx\nproperty float ny\nproperty float nz\n" : "", faces);
}

// Writes a triangle for each pair, in the cells of a grid. All fronts face up.
static void write_corners(FILE *stream)
{
    uint32_t state = 4;
    for (int cell = 0; cell < PAIRS; cell++) {
        const double x = cell % ORDERS - 2.5, y = cell / ORDERS - 2.5;
        static const double corners[3][2] = {{-0.4, -0.4}, {0.4, -0.35}, {-0.1, 0.4}};
        for (int corner = 0; corner < 3; corner++)
            fprintf(stream, "%.17g %.17g %.17g\n",
                    x + corners[corner][0] + random_between(&state, -0.09, 0.09),
                    y + corners[corner][1] + random_between(&state, -0.09, 0.09),
                    random_between(&state, -0.3, 0.3));
    }
}

static void write_triangle(FILE *stream, const int corners[3], int order)
{
    fprintf(stream, "3 %d %d %d\n", corners[orders[order][0]], corners[orders[order][1]],
            corners[orders[order][2]]);
}

// Returns the order of the pair's first or second triangle.
static int order_of(int pair, bool second)
{
    return second ? pair % ORDERS : pair / ORDERS;
}

static void write_pairs(char path[TEMPORARY_PATH], bool second)
{
    FILE *stream = temporary_open(path);
    write_head(stream, 3 * PAIRS, PAIRS, false);
    write_corners(stream);
    for (int pair = 0; pair < PAIRS; pair++)
        write_triangle(stream, (int[]){3 * pair, 3 * pair + 1, 3 * pair + 2},
                       order_of(pair, second));
    temporary_close(stream);
}

// Whether the first and the second mesh are two-sided.
typedef struct {
    bool first, second;
} Sides;

static void write_scene(char path[TEMPORARY_PATH], const char *first, const char *second,
                        Sides sides)
{
    FILE *stream = temporary_open(path);
    fprintf(stream,
            "background 0 0 0\ndefine one silhouette diffuse 1 0 0\n"
            "define other silhouette diffuse 0 1 0\nup 0 1 0\ncamera 0.3 0.2 7 0 0 0 50\n"
            "sides %s\nmaterial one\nply_file %s\nsides %s\nmaterial other\nply_file %s\n",
            sides.first ? "two" : "one", first, sides.second ? "two" : "one", second);
    temporary_close(stream);
}

// Writes the id that each pixel hits.
static void see(const char *scene, const KernelChoice *form, uint32_t ids[SIDE * SIDE])
{
    FREED_BY(layers_free) Layers layers = {0};
    Error error = {0};
    PictureRequest request = picture_request(scene, 1);
    request.width = request.height = SIDE;
    request.choice = *form;
    request.group_width = request.group_height = form_group(form);
    request.layers = &layers;
    if (!aov_read_list("primitive", &request.aovs, &error))
        fail_msg("%s", error.text);
    FREED_BY(framebuffer_free) Framebuffer picture = rendered(&request);
    for (uint32_t i = 0; i < SIDE * SIDE; i++) {
        ids[i] = *layers_at(&layers, i % SIDE, i / SIDE);
        assert_int_equal(picture.pixels[i][0] > 0, ids[i] < PAIRS);
        assert_int_equal(picture.pixels[i][1] > 0, ids[i] >= PAIRS && ids[i] != NOTHING);
    }
}

// Returns the id that must win. The eye is above the triangles, so it sees the front of triangles
// that are not reversed.
static uint32_t expected_id(uint32_t pair, Sides sides)
{
    if (sides.first || !is_reversed(order_of((int)pair, false)))
        return pair;
    if (sides.second || !is_reversed(order_of((int)pair, true)))
        return PAIRS + pair;
    return NOTHING;
}

TEST(the_lowest_id_that_may_be_met_is_seen_at_every_pixel)
{
    char first[TEMPORARY_PATH], second[TEMPORARY_PATH], scene[TEMPORARY_PATH];
    write_pairs(first, false);
    write_pairs(second, true);
    for (size_t form = 0; form < FORMS; form++) {
        uint32_t covered[SIDE * SIDE], seen[SIDE * SIDE], counts[PAIRS] = {0};
        for (int sides = 3; sides >= 0; sides--) {
            const Sides which = {(sides & 1) != 0, (sides & 2) != 0};
            write_scene(scene, first, second, which);
            see(scene, &forms[form], sides == 3 ? covered : seen);
            unlink(scene);
            for (uint32_t i = 0; sides == 3 && i < SIDE * SIDE; i++)
                if (covered[i] != NOTHING) {
                    assert_in_range(covered[i], 0, PAIRS - 1);
                    counts[covered[i]]++;
                }
            for (uint32_t i = 0; sides < 3 && i < SIDE * SIDE; i++)
                assert_int_equal(seen[i],
                                 covered[i] == NOTHING ? NOTHING : expected_id(covered[i], which));
        }
        for (int pair = 0; pair < PAIRS; pair++)
            assert_in_range(counts[pair], 50, SIDE * SIDE);
    }
    unlink(first);
    unlink(second);
}

#define WAVES 9 // vertices along a side of the sheet

static double wave(double x, double y)
{
    return 0.25 * sin(3 * x) * cos(2.5 * y);
}

// Writes a wavy sheet with smooth normals and all corners in this order. A reversed sheet has
// reversed normals.
static void write_sheet(char path[TEMPORARY_PATH], int order)
{
    FILE *stream = temporary_open(path);
    const double sign = is_reversed(order) ? -1 : 1;
    write_head(stream, WAVES * WAVES, 2 * (WAVES - 1) * (WAVES - 1), true);
    for (int vertex = 0; vertex < WAVES * WAVES; vertex++) {
        const double x = vertex % WAVES * 0.31 - 1.21, y = vertex / WAVES * 0.29 - 1.13;
        fprintf(stream, "%.17g %.17g %.17g %.9g %.9g %.9g\n", x, y, wave(x, y),
                sign * -0.75 * cos(3 * x) * cos(2.5 * y), sign * 0.625 * sin(3 * x) * sin(2.5 * y),
                sign);
    }
    for (int row = 0; row + 1 < WAVES; row++)
        for (int column = 0; column + 1 < WAVES; column++) {
            const int at = row * WAVES + column;
            write_triangle(stream, (int[]){at, at + 1, at + WAVES + 1}, order);
            write_triangle(stream, (int[]){at, at + WAVES + 1, at + WAVES}, order);
        }
    temporary_close(stream);
}

// Renders the sheet with mirrors and with lights on both sides. The copy has another color. With
// copy_order -1, there is no copy.
static Framebuffer draw_sheet(int first_order, int copy_order, const char *sides,
                              const KernelChoice *form)
{
    char sheet[TEMPORARY_PATH], copy[TEMPORARY_PATH], scene[TEMPORARY_PATH];
    write_sheet(sheet, first_order);
    write_sheet(copy, copy_order < 0 ? 0 : copy_order);
    FILE *stream = temporary_open(scene);
    fprintf(stream,
            "background 0.2 0.3 0.5\nmax_level 5\nlight 2 -1 2.5 0.5\nlight -1 1.4 -1.7 0.4\n"
            "light 1.5 0.3 0.35 0.3\ndefine bright matte diffuse 0.9 0.7 0.3 reflectivity 0.4\n"
            "define dark blinn_phong diffuse 0.1 0.2 0.3\ncamera 1.1 -2.4 1.3 0 0 0 60\n"
            "material 2\nsphere 0.4 0.1 0.8 0.3\nsides %s\nmaterial bright\nply_file %s\n",
            sides, sheet);
    if (copy_order >= 0)
        fprintf(stream, "material dark\nply_file %s\n", copy);
    temporary_close(stream);
    PictureRequest request = picture_request(scene, 1);
    request.width = request.height = SIDE;
    request.choice = *form;
    request.group_width = request.group_height = form_group(form);
    const Framebuffer picture = rendered(&request);
    unlink(sheet);
    unlink(copy);
    unlink(scene);
    return picture;
}

static void assert_same(const Framebuffer *one, Framebuffer *other)
{
    assert_memory_equal(one->pixels, other->pixels, SIDE * SIDE * sizeof *one->pixels);
    framebuffer_free(other);
}

TEST(a_copy_of_a_mesh_changes_no_bit_of_its_picture)
{
    for (size_t form = 0; form < FORMS; form++)
        for (int two_sided = 0; two_sided < 2; two_sided++) {
            const char *sides = two_sided == 1 ? "two" : "one";
            Framebuffer alone = draw_sheet(0, -1, sides, &forms[form]);
            for (int order = 0; order < (two_sided == 1 ? ORDERS : 3); order++) {
                Framebuffer doubled = draw_sheet(0, order, sides, &forms[form]);
                assert_same(&alone, &doubled);
            }
            framebuffer_free(&alone);
        }
}

TEST(turning_the_corners_of_all_triangles_changes_no_bit)
{
    for (size_t form = 0; form < FORMS; form++) {
        Framebuffer usual = draw_sheet(0, -1, "one", &forms[form]);
        for (int order = 1; order < 3; order++) {
            Framebuffer turned = draw_sheet(order, -1, "one", &forms[form]);
            assert_same(&usual, &turned);
        }
        framebuffer_free(&usual);
    }
}
