// SPDX-License-Identifier: MIT
// Tests that no light reaches points whose face is turned away from it, in colors and channels and
// in every form of the kernels. The oracle and the pixels worked out by hand (cli/test_explain.py)
// test the same for spheres and for solids seen from outside.
#include "image/form.h"
#include "image/rendered.h"
#include "unit/cmocka_all.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

#define PI     3.14159265358979
#define SIDE   97
#define RINGS  4
#define SLICES 7
#define SPOKES 24

typedef struct {
    Vec3 corners[3], normals[3];
} Triangle;

typedef struct {
    Triangle triangles[2 * RINGS * SLICES];
    uint32_t count;
} Solid;

static void add_triangle(Solid *solid, Vec3 a, Vec3 b, Vec3 c)
{
    solid->triangles[solid->count++] = (Triangle){{a, b, c}, {a, b, c}};
}

static Vec3 on_ball(int ring, int slice)
{
    const double height = PI * ring / RINGS, around = 2 * PI * slice / SLICES;
    return vec3(sin(height) * cos(around), sin(height) * sin(around), cos(height));
}

// Returns a coarse ball of radius 1 with the normals of a smooth ball.
static Solid ball(void)
{
    Solid solid = {.count = 0};
    for (int ring = 0; ring < RINGS; ring++)
        for (int slice = 0; slice < SLICES; slice++) {
            const Vec3 high = on_ball(ring, slice), low = on_ball(ring + 1, slice);
            const Vec3 beside = on_ball(ring + 1, slice + 1), above = on_ball(ring, slice + 1);
            if (ring + 1 < RINGS)
                add_triangle(&solid, high, low, beside);
            if (ring > 0)
                add_triangle(&solid, high, beside, above);
        }
    return solid;
}

// Returns triangles in planes through the z axis, with normals that are tilted toward the axis.
static Solid spokes(void)
{
    Solid solid = {.count = 0};
    for (int spoke = 0; spoke < SPOKES; spoke++) {
        const double around = 2 * PI * (spoke + 0.37) / SPOKES;
        const Vec3 out = {cos(around), sin(around), 0}, up = {0, 0, 1};
        const Vec3 a = vec3_scale(out, 0.31);
        const Vec3 b = vec3_add(vec3_scale(out, 1.13), vec3_scale(up, -0.17));
        const Vec3 c = vec3_add(vec3_scale(out, 0.87), vec3_scale(up, 0.71));
        const Vec3 face = vec3_normalize(vec3_cross(vec3_sub(b, a), vec3_sub(c, a)));
        add_triangle(&solid, a, b, c);
        for (int corner = 0; corner < 3; corner++)
            solid.triangles[spoke].normals[corner] = vec3_sub(face, out);
    }
    return solid;
}

static void write_solid(const Solid *solid, FILE *stream)
{
    fprintf(stream,
            "ply\nformat ascii 1.0\nelement vertex %u\nproperty double x\nproperty double y\n"
            "property double z\nproperty float nx\nproperty float ny\nproperty float nz\n"
            "element face %u\nproperty list uchar int vertex_indices\nend_header\n",
            3 * solid->count, solid->count);
    for (uint32_t i = 0; i < 3 * solid->count; i++) {
        const Vec3 p = solid->triangles[i / 3].corners[i % 3];
        const Vec3 n = solid->triangles[i / 3].normals[i % 3];
        fprintf(stream, "%.17g %.17g %.17g %.9g %.9g %.9g\n", p.x, p.y, p.z, n.x, n.y, n.z);
    }
    for (uint32_t i = 0; i < solid->count; i++)
        fprintf(stream, "3 %u %u %u\n", 3 * i, 3 * i + 1, 3 * i + 2);
}

// A light and a white object in front of a black background.
typedef struct {
    const Solid *solid;
    Vec3 eye, look_at, light;
} Stage;

static void stage_write(const Stage *stage, char path[TEMPORARY_PATH], char mesh[TEMPORARY_PATH])
{
    FILE *stream = temporary_open(mesh), *scene = temporary_open(path);
    write_solid(stage->solid, stream);
    temporary_close(stream);
    fprintf(scene, "background 0 0 0\nambient 0\nmaterial 1\nsides two\nply_file %s\n", mesh);
    fprintf(scene, "light %.17g %.17g %.17g 1\n", stage->light.x, stage->light.y, stage->light.z);
    fprintf(scene, "camera %g %g %g %g %g %g 60\n", stage->eye.x, stage->eye.y, stage->eye.z,
            stage->look_at.x, stage->look_at.y, stage->look_at.z);
    temporary_close(scene);
}

// The contents of a pixel.
typedef struct {
    uint32_t primitive;
    bool lit; // in the color and in the channel
} Seen;

// Renders a picture of SIDE x SIDE pixels.
static void see(const Stage *stage, const KernelChoice *form, Seen *seen)
{
    char scene[TEMPORARY_PATH], mesh[TEMPORARY_PATH];
    FREED_BY(layers_free) Layers layers;
    stage_write(stage, scene, mesh);
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
    remove(mesh);
}

TEST(no_light_enters_a_closed_two_sided_mesh)
{
    const Solid solid = ball();
    for (size_t form = 0; form < FORMS; form++) {
        Seen seen[SIDE * SIDE];
        const Stage stage = {&solid, {0.3, -0.2, 0.1}, {1, 1, 0.3}, {0.8, 1.3, 0.9}};
        see(&stage, &form_all[form], seen);
        for (uint32_t i = 0; i < SIDE * SIDE; i++) {
            assert_int_not_equal(seen[i].primitive, NOTHING);
            assert_false(seen[i].lit);
        }
    }
}

// The light is in the planes of all spokes, within rounding.
TEST(all_points_of_a_triangle_agree_about_a_light_in_its_plane)
{
    const Solid solid = spokes();
    for (size_t form = 0; form < FORMS; form++) {
        Seen seen[SIDE * SIDE];
        uint32_t dark[SPOKES] = {0}, lit[SPOKES] = {0}, spokes_seen = 0;
        const Stage stage = {&solid, {0.6, -1.4, 1.6}, {0, 0, 0.2}, {0, 0, 0.27}};
        see(&stage, &form_all[form], seen);
        for (uint32_t i = 0; i < SIDE * SIDE; i++)
            if (seen[i].primitive != NOTHING)
                (seen[i].lit ? lit : dark)[seen[i].primitive]++;
        for (int spoke = 0; spoke < SPOKES; spoke++) {
            spokes_seen += lit[spoke] + dark[spoke] > 20;
            assert_true(lit[spoke] == 0 || dark[spoke] == 0);
        }
        assert_in_range(spokes_seen, SPOKES / 2, SPOKES);
    }
}
