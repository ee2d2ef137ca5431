// SPDX-License-Identifier: MIT
// Tests that the triangle with the lowest id wins among coincident triangles. This must hold for
// every order of corners and in every form of the kernels. A copy of a mesh at the same place must
// not change a bit.
#include "image/form.h"
#include "image/rendered.h"
#include "unit/cmocka_all.h"
#include "unit/random.h"

#include <unistd.h>

#define ORDERS 6
#define PAIRS  (ORDERS * ORDERS)
#define SIDE   181

// The first three orders keep the front side, and the other three orders reverse it.
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

// Writes the first or second triangle of each pair. Each pair has a cell of a grid. A triangle's
// front faces up unless its order is_reversed.
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

// The meshes that are two-sided.
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

// Stores the id of the triangle at each pixel.
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
    for (size_t form = 0; form < FORMS_FEW; form++) {
        uint32_t covered[SIDE * SIDE], seen[SIDE * SIDE], counts[PAIRS] = {0};
        for (int sides = 3; sides >= 0; sides--) {
            const Sides which = {(sides & 1) != 0, (sides & 2) != 0};
            write_scene(scene, first, second, which);
            see(scene, &form_few[form], sides == 3 ? covered : seen);
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

// Smooth and flat objects with mirrors, shadows and lights on both sides. The first %s stands for
// the value of `sides`, and the second %s for the statements of the copies.
#define STATEMENTS                                                                                 \
    "background 0.2 0.3 0.5\nmax_level 5\nlight 2 -1 2.5 0.5\nlight -1 1.4 -1.7 0.4\n"             \
    "define bright matte diffuse 0.9 0.7 0.3 reflectivity 0.4\nmaterial 2\nsphere 1 0.1 0.8 0.3\n" \
    "sides %s\nmaterial bright\nply_file " CONE "\nply_file " BALL "\n%s"
#define CONE   CLRT_SOURCE_FOLDER "/scenes/cone.ply"
#define BALL   CLRT_SOURCE_FOLDER "/tests/image/ball.ply"
#define COPIES "material 1\nply_file " CONE "\nply_file " BALL "\n"

// tests/extremes/one_picture also reorders the copies' corners.
TEST(copies_of_meshes_change_no_bit_in_any_form)
{
    for (size_t form = 0; form < 2 * FORMS; form++) {
        char paths[2][TEMPORARY_PATH];
        PictureRequest requests[2];
        for (int copied = 0; copied < 2; copied++) {
            FILE *stream = temporary_open(paths[copied]);
            fprintf(stream, STATEMENTS, form < FORMS ? "one" : "two", copied == 1 ? COPIES : "");
            temporary_close(stream);
            requests[copied] =
                rendered_in_form(picture_request(paths[copied], 1), &form_all[form % FORMS]);
            requests[copied].width = requests[copied].height = SIDE;
        }
        rendered_expect_same(&requests[0], &requests[1], 1);
        unlink(paths[0]);
        unlink(paths[1]);
    }
}
