// SPDX-License-Identifier: MIT
// Tests that no light reaches points whose face is turned away from the light, in colors and
// channels and in the forms of form_few. The oracle and the pixels worked out by hand
// (tests/cli/test_explain.py) test this for spheres and for solids seen from outside.
#include "image/form.h"
#include "image/rendered.h"
#include "unit/cmocka_all.h"

#include <math.h>
#include <string.h>

#define PI     3.14159265358979
#define SIDE   97
#define SPOKES 24

// Writes triangles in planes through the z axis, with normals that are tilted toward the axis.
static void write_spokes(char path[TEMPORARY_PATH])
{
    double positions[3 * SPOKES][3];
    float normals[3 * SPOKES][3];
    uint32_t triangles[SPOKES][3];
    for (uint32_t i = 0; i < 3 * SPOKES; i++) {
        static const double places[3][2] = {{0.31, 0}, {1.13, -0.17}, {0.87, 0.71}};
        const double around = 2 * PI * (i / 3 + 0.37) / SPOKES;
        const Vec3 out = {cos(around), sin(around), 0}, face = {sin(around), -cos(around), 0};
        const Vec3 normal = vec3_sub(face, out), place = vec3_scale(out, places[i % 3][0]);
        memcpy(positions[i], (double[3]){place.x, place.y, places[i % 3][1]}, sizeof *positions);
        memcpy(normals[i], (float[3]){(float)normal.x, (float)normal.y, 0}, sizeof *normals);
        triangles[i / 3][i % 3] = i;
    }
    temporary_mesh(path, &(Mesh){.positions = positions,
                                 .normals = normals,
                                 .triangles = triangles,
                                 .vertex_count = 3 * SPOKES,
                                 .triangle_count = SPOKES});
}

// A light and a white object in front of a black background.
typedef struct {
    const char *mesh;
    Vec3 eye, look_at, light;
} Stage;

static void stage_write(const Stage *stage, char path[TEMPORARY_PATH])
{
    FILE *scene = temporary_open(path);
    fprintf(scene, "background 0 0 0\nambient 0\nmaterial 1\nsides two\nply_file %s\n",
            stage->mesh);
    fprintf(scene, "light %.17g %.17g %.17g 1\n", stage->light.x, stage->light.y, stage->light.z);
    fprintf(scene, "camera %g %g %g %g %g %g 60\n", stage->eye.x, stage->eye.y, stage->eye.z,
            stage->look_at.x, stage->look_at.y, stage->look_at.z);
    temporary_close(scene);
}

// The contents of a pixel.
typedef struct {
    uint32_t primitive;
    bool lit; // by the color and by the channel
} Seen;

// Stores the contents of the picture's SIDE x SIDE pixels.
static void see(const Stage *stage, const KernelChoice *form, Seen *seen)
{
    char scene[TEMPORARY_PATH];
    FREED_BY(layers_free) Layers layers;
    stage_write(stage, scene);
    PictureRequest request = rendered_in_form(picture_request(scene, 1), form);
    request.width = request.height = SIDE;
    FREED_BY(framebuffer_free)
    Framebuffer picture = rendered_with(request, "primitive,shadow", &layers);
    for (uint32_t i = 0; i < SIDE * SIDE; i++) {
        const uint32_t *v = layers_at(&layers, i % SIDE, i / SIDE);
        seen[i] = (Seen){v[0], layer_float(v[1]) > 0};
        assert_int_equal(seen[i].lit, picture.pixels[i][0] > 0);
    }
    remove(scene);
}

TEST(no_light_enters_a_closed_two_sided_mesh)
{
    for (size_t form = 0; form < FORMS_FEW; form++) {
        Seen seen[SIDE * SIDE];
        const Stage stage = {CLRT_SOURCE_FOLDER "/tests/image/ball.ply",
                             {0.3, -0.2, 0.1},
                             {1, 1, 0.3},
                             {0.8, 1.3, 0.9}};
        see(&stage, &form_few[form], seen);
        for (uint32_t i = 0; i < SIDE * SIDE; i++) {
            assert_int_not_equal(seen[i].primitive, NOTHING);
            assert_false(seen[i].lit);
        }
    }
}

// The light is in the planes of all spokes, within rounding.
TEST(all_points_of_a_triangle_agree_about_a_light_in_its_plane)
{
    char spokes[TEMPORARY_PATH];
    write_spokes(spokes);
    for (size_t form = 0; form < FORMS_FEW; form++) {
        Seen seen[SIDE * SIDE];
        uint32_t dark[SPOKES] = {0}, lit[SPOKES] = {0}, spokes_seen = 0;
        const Stage stage = {spokes, {0.6, -1.4, 1.6}, {0, 0, 0.2}, {0, 0, 0.27}};
        see(&stage, &form_few[form], seen);
        for (uint32_t i = 0; i < SIDE * SIDE; i++)
            if (seen[i].primitive != NOTHING)
                (seen[i].lit ? lit : dark)[seen[i].primitive]++;
        for (int spoke = 0; spoke < SPOKES; spoke++) {
            spokes_seen += lit[spoke] + dark[spoke] > 20;
            assert_true(lit[spoke] == 0 || dark[spoke] == 0);
        }
        assert_in_range(spokes_seen, SPOKES / 2, SPOKES);
    }
    remove(spokes);
}
