// SPDX-License-Identifier: MIT
// Tests that the triangle with the lowest id wins among coincident triangles. This must hold for
// every order of corners and in every form of the kernels. A copy of a mesh at the same place must
// not change a bit.
#include "image/form.h"
#include "image/rendered.h"
#include "unit/cmocka_all.h"
#include "unit/random.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

#define ORDERS 6
#define PAIRS  (ORDERS * ORDERS)
#define SIDE   181

// The first three orders keep the front side, and the others reverse it.
static const int orders[ORDERS][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1},
                                      {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};

static bool is_reversed(int order)
{
    return order >= 3;
}

static void set_triangle(uint32_t triangle[3], const uint32_t corners[3], int order)
{
    for (int i = 0; i < 3; i++)
        triangle[i] = corners[orders[order][i]];
}

// Returns the order of the pair's first or second triangle.
static int order_of(int pair, bool second)
{
    return second ? pair % ORDERS : pair / ORDERS;
}

// Writes a triangle for each pair, in the cells of a grid. All fronts face up.
static void write_pairs(char path[TEMPORARY_PATH], bool second)
{
    static const double corners[3][2] = {{-0.4, -0.4}, {0.4, -0.35}, {-0.1, 0.4}};
    double positions[3 * PAIRS][3];
    uint32_t triangles[PAIRS][3];
    uint64_t state = 4;
    for (int cell = 0; cell < PAIRS; cell++) {
        const uint32_t first = 3 * (uint32_t)cell;
        for (int corner = 0; corner < 3; corner++) {
            double *position = positions[3 * cell + corner];
            position[0] = cell % ORDERS - 2.5 + corners[corner][0];
            position[1] = cell / ORDERS - 2.5 + corners[corner][1];
            position[0] += random_between(&state, -0.09, 0.09);
            position[1] += random_between(&state, -0.09, 0.09);
            position[2] = random_between(&state, -0.3, 0.3);
        }
        set_triangle(triangles[cell], (uint32_t[]){first, first + 1, first + 2},
                     order_of(cell, second));
    }
    temporary_mesh(path, &(Mesh){.positions = positions,
                                 .triangles = triangles,
                                 .vertex_count = 3 * PAIRS,
                                 .triangle_count = PAIRS});
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
    FREED_BY(layers_free) Layers layers;
    PictureRequest request = rendered_in_form(picture_request(scene, 1), form);
    request.width = request.height = SIDE;
    FREED_BY(framebuffer_free) Framebuffer picture = rendered_with(request, "primitive", &layers);
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
            see(scene, &form_all[form], sides == 3 ? covered : seen);
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

// Writes a wavy sheet with smooth normals and all corners in this order. A reversed sheet has
// reversed normals.
static void write_sheet(char path[TEMPORARY_PATH], int order)
{
    double positions[WAVES * WAVES][3];
    float normals[WAVES * WAVES][3];
    uint32_t triangles[2 * WAVES * WAVES][3], count = 0;
    const double sign = is_reversed(order) ? -1 : 1;
    for (uint32_t vertex = 0; vertex < WAVES * WAVES; vertex++) {
        const double x = vertex % WAVES * 0.31 - 1.21, y = vertex / WAVES * 0.29 - 1.13;
        const double point[3] = {x, y, 0.25 * sin(3 * x) * cos(2.5 * y)};
        memcpy(positions[vertex], point, sizeof point);
        normals[vertex][0] = (float)(sign * -0.75 * cos(3 * x) * cos(2.5 * y));
        normals[vertex][1] = (float)(sign * 0.625 * sin(3 * x) * sin(2.5 * y));
        normals[vertex][2] = (float)sign;
    }
    for (uint32_t at = 0; at < WAVES * (WAVES - 1); at++)
        if (at % WAVES + 1 < WAVES) {
            const uint32_t above = at + WAVES;
            set_triangle(triangles[count++], (uint32_t[]){at, at + 1, above + 1}, order);
            set_triangle(triangles[count++], (uint32_t[]){at, above + 1, above}, order);
        }
    temporary_mesh(path, &(Mesh){.positions = positions,
                                 .normals = normals,
                                 .triangles = triangles,
                                 .vertex_count = WAVES * WAVES,
                                 .triangle_count = count});
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
    PictureRequest request = rendered_in_form(picture_request(scene, 1), form);
    request.width = request.height = SIDE;
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
            FREED_BY(framebuffer_free)
            Framebuffer alone = draw_sheet(0, -1, sides, &form_all[form]);
            for (int order = 0; order < (two_sided == 1 ? ORDERS : 3); order++) {
                Framebuffer doubled = draw_sheet(0, order, sides, &form_all[form]);
                assert_same(&alone, &doubled);
            }
        }
}

TEST(turning_the_corners_of_all_triangles_changes_no_bit)
{
    for (size_t form = 0; form < FORMS; form++) {
        FREED_BY(framebuffer_free) Framebuffer usual = draw_sheet(0, -1, "one", &form_all[form]);
        for (int order = 1; order < 3; order++) {
            Framebuffer turned = draw_sheet(order, -1, "one", &form_all[form]);
            assert_same(&usual, &turned);
        }
    }
}
