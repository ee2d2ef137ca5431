// SPDX-License-Identifier: MIT
// Tests that a light does not reach points whose face is turned away from it. This must hold for
// colors and channels in every form of the kernels. The ball is convex, so only a point's own face
// can occlude a light.
#include "image/form.h"
#include "image/rendered.h"
#include "image/temporary.h"
#include "unit/cmocka_all.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

#define PI     3.14159265358979
#define SIDE   97
#define RINGS  4
#define SLICES 7
#define SPOKES 24

// The test ignores lights whose height over a face is smaller than this.
#define CLEAR 1e-4

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
    const Solid *solid; // NULL: a sphere of radius 1
    const char *sides;
    Vec3 eye, look_at, light;
} Stage;

// Writes the scene and, if it has a solid, its mesh.
static void stage_write(const Stage *stage, char path[TEMPORARY_PATH], char mesh[TEMPORARY_PATH])
{
    FILE *scene = temporary_open(path);
    fprintf(scene, "background 0 0 0\nambient 0\nmaterial 1\nsides %s\n", stage->sides);
    fprintf(scene, "light %.17g %.17g %.17g 1\n", stage->light.x, stage->light.y, stage->light.z);
    fprintf(scene, "camera %g %g %g %g %g %g 60\n", stage->eye.x, stage->eye.y, stage->eye.z,
            stage->look_at.x, stage->look_at.y, stage->look_at.z);
    if (stage->solid != NULL) {
        FILE *stream = temporary_open(mesh);
        write_solid(stage->solid, stream);
        temporary_close(stream);
        fprintf(scene, "ply_file %s\n", mesh);
    } else {
        fprintf(scene, "sphere 0 0 0 1\n");
    }
    temporary_close(scene);
}

// The contents of a pixel.
typedef struct {
    Vec3 normal, point;
    uint32_t primitive;
    bool lit; // in the color and in the channel
} Seen;

// Renders a picture of SIDE x SIDE pixels.
static void see(const Stage *stage, const KernelChoice *form, Seen *seen)
{
    char scene[TEMPORARY_PATH], mesh[TEMPORARY_PATH] = "";
    FREED_BY(layers_free) Layers layers;
    stage_write(stage, scene, mesh);
    PictureRequest request = rendered_in_form(picture_request(scene, 1), form);
    request.width = request.height = SIDE;
    FREED_BY(framebuffer_free)
    Framebuffer picture = rendered_with(request, "normal,position,primitive,shadow", &layers);
    for (uint32_t i = 0; i < SIDE * SIDE; i++) {
        const uint32_t *v = layers_at(&layers, i % SIDE, i / SIDE);
        seen[i] = (Seen){layer_vector(v), layer_vector(v + 3), v[6], layer_float(v[7]) > 0};
        assert_int_equal(seen[i].lit, picture.pixels[i][0] > 0);
    }
    remove(scene);
    remove(mesh);
}

// Returns the light's height over the face that a pixel shows; positive on the eye's side.
static double height_over_face(const Stage *stage, const Seen *seen)
{
    const Vec3 *c = stage->solid->triangles[seen->primitive].corners;
    const Vec3 face = vec3_cross(vec3_sub(c[1], c[0]), vec3_sub(c[2], c[0]));
    const double viewer = vec3_dot(face, vec3_sub(stage->eye, c[0]));
    const double light = vec3_dot(face, vec3_sub(stage->light, c[0]));
    return viewer < 0 ? -light : light;
}

typedef struct {
    uint32_t judged, turned_away, lit; // numbers of pixels; turned_away: only the normal faces the
    // light
} Counts;

// Judges the pixels of a convex solid that is seen from outside.
static Counts judge_outside(const Stage *stage, const Seen *seen)
{
    Counts counts = {0};
    for (uint32_t i = 0; i < SIDE * SIDE; i++) {
        if (seen[i].primitive == NOTHING)
            continue;
        const double cosine = vec3_dot(seen[i].normal, vec3_sub(stage->light, seen[i].point));
        const double height = stage->solid == NULL ? cosine : height_over_face(stage, &seen[i]);
        if (fabs(cosine) < CLEAR || fabs(height) < CLEAR)
            continue;
        counts.judged++;
        counts.turned_away += cosine > 0 && height < 0;
        counts.lit += seen[i].lit;
        assert_int_equal(seen[i].lit, cosine > 0 && height > 0);
    }
    return counts;
}

static void check_outside(const Solid *solid)
{
    static const Vec3 lights[] = {{4, -0.3, 2}, {-3, 1, -2}, {1.2, -1, -2.9}};
    for (size_t light = 0; light < sizeof lights / sizeof *lights; light++)
        for (size_t form = 0; form < FORMS; form++) {
            Seen seen[SIDE * SIDE];
            const Stage stage = {solid, "one", {0.4, -2.1, 0.6}, {0, 0, 0}, lights[light]};
            see(&stage, &form_all[form], seen);
            const Counts counts = judge_outside(&stage, seen);
            assert_in_range(counts.judged, 2000, SIDE * SIDE);
            assert_in_range(counts.lit, 50, counts.judged);
            if (solid != NULL)
                assert_in_range(counts.turned_away, 40, counts.judged);
        }
}

TEST(faces_turned_away_get_no_light_through_a_one_sided_mesh)
{
    const Solid solid = ball();
    check_outside(&solid);
}

TEST(a_sphere_seen_from_outside_is_lit_by_its_normal_alone)
{
    check_outside(NULL);
}

// Checks that no pixel is lit if the eye is inside the solid.
static void check_inside(const Solid *solid)
{
    for (size_t form = 0; form < FORMS; form++) {
        Seen seen[SIDE * SIDE];
        const Stage stage = {solid, "two", {0.3, -0.2, 0.1}, {1, 1, 0.3}, {0.8, 1.3, 0.9}};
        see(&stage, &form_all[form], seen);
        for (uint32_t i = 0; i < SIDE * SIDE; i++) {
            assert_int_not_equal(seen[i].primitive, NOTHING);
            assert_false(seen[i].lit);
        }
    }
}

TEST(no_light_enters_a_closed_two_sided_mesh)
{
    const Solid solid = ball();
    check_inside(&solid);
}

TEST(no_light_enters_a_sphere)
{
    check_inside(NULL);
}

// The light is in the planes of all spokes, within rounding.
TEST(all_points_of_a_triangle_agree_about_a_light_in_its_plane)
{
    const Solid solid = spokes();
    for (size_t form = 0; form < FORMS; form++) {
        Seen seen[SIDE * SIDE];
        uint32_t dark[SPOKES] = {0}, lit[SPOKES] = {0}, spokes_seen = 0;
        const Stage stage = {&solid, "two", {0.6, -1.4, 1.6}, {0, 0, 0.2}, {0, 0, 0.27}};
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
