// SPDX-License-Identifier: MIT
// Explanations of eleven pixels, compared with rays computed by hand. Pictures have 5 x 5 pixels
// and a field of view of 90 degrees. The ray through pixel (2, 2) points at the camera's target.
// Each pixel beside it tilts the ray by 0.4. The floor is a square of two triangles: 0 below its
// diagonal from (-10, -10) to (10, 10), and 1 above.
#include "explain/explainer.h"
#include "image/picture.h"
#include "unit/cmocka_all.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

// All numbers below are rounded to six digits.
#define NEAR 2e-6

static const char floor_text[] =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
    "-10 -10 0\n10 -10 0\n10 10 0\n-10 10 0\n3 0 1 2\n3 0 2 3\n";

// The floor's first triangle, with normals that lean by 0.6 toward x.
static const char leaning_text[] =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    "property float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "-10 -10 0 0.6 0 0.8\n10 -10 0 0.6 0 0.8\n10 10 0 0.6 0 0.8\n3 0 1 2\n";

#define SCENE(text)                                                                                \
    "size 5 5\nambient 0.1\nbackground 0 0 1\n"                                                    \
    "define plain matte diffuse 0.8 0.8 0.8 kd 0.5\n"                                              \
    "define mirror matte diffuse 1 1 1 kd 0.5 reflectivity 0.5\n" text

static char folder[64];

// The explanation of one pixel, copied from the explainer.
typedef struct {
    uint32_t x, y;
    ExplainedRay rays[4];
    ExplainedLight lights[4]; // the first light of each ray
    PrimitiveName names[4], blockers[4];
    uint32_t ray_count;
    double background_weight;
    double color[3];
} Told;

static void keep(Explainer *explainer, const Framebuffer *picture, void *context)
{
    Told *told = context;
    Error error = {0};
    ExplainedSample sample;
    (void)picture;
    if (!explainer_trace(explainer, (uint32_t[]){told->x, told->y}, 0, &sample, &error))
        fail_msg("%s", error.text);
    told->ray_count = sample.ray_count;
    told->background_weight = sample.background_weight;
    assert_in_range(sample.ray_count, 1, 4);
    for (uint32_t i = 0; i < 3; i++)
        told->color[i] = sample.steps[i] * 0x1p-32;
    for (uint32_t i = 0; i < sample.ray_count; i++) {
        told->rays[i] = sample.rays[i];
        if (sample.rays[i].primitive == NOTHING)
            continue;
        told->names[i] = name_primitive(explainer->scene, sample.rays[i].primitive);
        told->lights[i] = sample.rays[i].lights[0];
        if (told->lights[i].state == LIGHT_BLOCKED)
            told->blockers[i] = name_primitive(explainer->scene, told->lights[i].blocker);
    }
}

static void write_file(const char *name, const char *text, char path[96])
{
    snprintf(path, 96, "%s/%s", folder, name);
    FILE *stream = fopen(path, "w");
    assert_non_null(stream);
    fputs(text, stream);
    assert_int_equal(fclose(stream), 0);
}

static Told tell(const char *text, uint32_t x, uint32_t y)
{
    char path[96];
    Error error = {0};
    Framebuffer picture = {0};
    Told told = {.x = x, .y = y};
    write_file("scene.scn", text, path);
    PictureRequest request = picture_request(path, 1);
    request.visit = keep;
    request.visit_context = &told;
    if (!picture_render(&picture, &request, &error))
        fail_msg("%s", error.text);
    framebuffer_free(&picture);
    return told;
}

static bool is_near(double value, double expected)
{
    return fabs(value - expected) <= NEAR * fmax(1, fabs(expected));
}

static void assert_vector(Vec3 v, double x, double y, double z)
{
    if (!is_near(v.x, x) || !is_near(v.y, y) || !is_near(v.z, z))
        fail_msg("(%.9g, %.9g, %.9g) is not (%.9g, %.9g, %.9g)", v.x, v.y, v.z, x, y, z);
}

static void assert_number(double value, double expected)
{
    if (!is_near(value, expected))
        fail_msg("%.9g is not %.9g", value, expected);
}

static void assert_sphere(const Told *told, uint32_t level, size_t number, double distance)
{
    assert_true(told->names[level].is_sphere);
    assert_int_equal(told->names[level].number, number);
    assert_number(told->rays[level].distance, distance);
    assert_true(told->rays[level].error >= 0 && told->rays[level].error < 1e-4);
}

static void assert_floor(const Told *told, uint32_t level, size_t number, double distance)
{
    assert_false(told->names[level].is_sphere);
    assert_int_equal(told->names[level].number, number);
    assert_number(told->rays[level].distance, distance);
    assert_true(told->rays[level].error > 0 && told->rays[level].error < 1e-4);
}

// The eye is at a distance of 5 from the center of a sphere of radius 1, so the hit is at 4. The
// hit faces the light at the eye: ambient 0.1 plus 0.5 * 0.5 * 1, times 0.8.
static void a_sphere_seen_head_on(void **state)
{
    (void)state;
    const Told told = tell(SCENE("light 0 -5 0 0.5\nmaterial plain\nsphere 0 0 0 1\n"
                                 "camera 0 -5 0 0 0 0 90\n"),
                           2, 2);
    assert_int_equal(told.ray_count, 1);
    assert_sphere(&told, 0, 1, 4);
    assert_vector(told.rays[0].point, 0, -1, 0);
    assert_vector(told.rays[0].normal, 0, -1, 0);
    assert_int_equal(told.lights[0].state, LIGHT_SEEN);
    assert_number(told.lights[0].cosine, 1);
    assert_number(told.lights[0].distance, 4);
    assert_number(told.lights[0].diffuse, 0.5);
    assert_number(told.color[0], 0.8 * 0.35);
    assert_number(told.background_weight, 0);
}

// The ray of pixel (0, 0) has direction (-0.8, 1, 0.8), which misses the sphere by 3.7 from its
// center.
static void a_ray_past_the_sphere(void **state)
{
    (void)state;
    const Told told = tell(SCENE("light 0 -5 0 0.5\nmaterial plain\nsphere 0 0 0 1\n"
                                 "camera 0 -5 0 0 0 0 90\n"),
                           0, 0);
    assert_int_equal(told.ray_count, 1);
    assert_int_equal(told.rays[0].primitive, NOTHING);
    assert_vector(told.rays[0].direction, -0.529813, 0.662266, 0.529813);
    assert_number(told.background_weight, 1);
    assert_number(told.color[2], 1);
}

#define LAMP_OVER_BALL "light 0 0 4 1\nmaterial plain\nply_file floor.ply\nsphere 0 0 1 0.5\n"

// The light is 4 above the point (1e-3, 0, 0). Between them is a ball of radius 0.5, whose lowest
// point is 0.5 away. The eye is sqrt(16 + 0.16) away.
static void a_point_under_a_ball(void **state)
{
    (void)state;
    const Told told = tell(SCENE(LAMP_OVER_BALL "camera 1e-3 -4 0.4 1e-3 0 0 90\n"), 2, 2);
    assert_floor(&told, 0, 0, 4.019950);
    assert_vector(told.rays[0].normal, 0, 0, 1);
    assert_int_equal(told.lights[0].state, LIGHT_BLOCKED);
    assert_true(told.blockers[0].is_sphere && told.blockers[0].number == 1);
    assert_number(told.lights[0].distance, 4);
    assert_number(told.lights[0].blocker_distance, 0.5);
    assert_number(told.lights[0].cosine, 1);
    assert_number(told.color[0], 0.08);
}

// The cone from the light that touches the ball has the sine 0.5 / 3. It intersects the floor at a
// radius of 4 * 0.169031 = 0.676123. At 0.65, the light is at a distance of sqrt(0.65^2 + 16) =
// 4.052468. The ball's center is 1.091310 along this line and 0.481182 off it. The hit is sqrt(0.25
// - 0.481182^2) = 0.135860 before the center: at 0.955450.
static void a_point_just_inside_a_shadows_edge(void **state)
{
    (void)state;
    const Told told = tell(SCENE(LAMP_OVER_BALL "camera 0.65 -4 0.4 0.65 0 0 90\n"), 2, 2);
    assert_floor(&told, 0, 0, 4.019950);
    assert_int_equal(told.lights[0].state, LIGHT_BLOCKED);
    assert_true(told.blockers[0].is_sphere && told.blockers[0].number == 1);
    assert_number(told.lights[0].distance, 4.052468);
    assert_number(told.lights[0].blocker_distance, 0.955450);
    assert_number(told.lights[0].cosine, 0.987053);
}

// At 0.7, the light is sqrt(0.49 + 16) away, its cosine is 4 / 4.060788, and nothing occludes it.
static void a_point_just_outside_a_shadows_edge(void **state)
{
    (void)state;
    const Told told = tell(SCENE(LAMP_OVER_BALL "camera 0.7 -4 0.4 0.7 0 0 90\n"), 2, 2);
    assert_floor(&told, 0, 0, 4.019950);
    assert_int_equal(told.lights[0].state, LIGHT_SEEN);
    assert_number(told.lights[0].distance, 4.060788);
    assert_number(told.lights[0].cosine, 0.985030);
    assert_number(told.color[0], 0.8 * (0.1 + 0.5 * 0.985030));
}

// Two mirror balls of radius 1 are 3 in front of and 3 behind the eye. The first ray has length 2,
// and reflected rays have length 4. Each reflection halves the weight, and rays of level 3 see the
// background. The light is at (0, -+2, 2) from every hit, at the cosine 1 / sqrt(2). Each ball adds
// 0.1 + 0.5 * 0.707107 = 0.453553 with weights 1/2, 1/4 and 1/8. The background adds 1/8 of blue.
static void a_mirror_of_a_mirror_of_a_mirror(void **state)
{
    (void)state;
    const Told told = tell(SCENE("light 0 0 2 1\nmaterial mirror\nsphere 0 3 0 1\nsphere 0 -3 0 1\n"
                                 "camera 0 0 0 0 1 0 90\n"),
                           2, 2);
    assert_int_equal(told.ray_count, 3);
    assert_sphere(&told, 0, 1, 2);
    assert_sphere(&told, 1, 2, 4);
    assert_sphere(&told, 2, 1, 4);
    for (uint32_t level = 0; level < 3; level++) {
        assert_number(told.rays[level].weight, ldexp(1, -(int)level));
        assert_number(told.rays[level].share, ldexp(0.5, -(int)level));
        assert_int_equal(told.lights[level].state, LIGHT_SEEN);
        assert_number(told.lights[level].cosine, 0.707107);
        assert_number(told.rays[level].shaded.x, 0.453553);
    }
    assert_vector(told.rays[1].direction, 0, -1, 0);
    assert_number(told.background_weight, 0.125);
    assert_number(told.color[0], 0.396859);
    assert_number(told.color[2], 0.521859);
}

// The line x = 0 is at a distance of 0.999 from the ball's center. Half its chord is sqrt(1 -
// 0.999^2) = 0.0447102, so the ray from y = -5 hits after 4.955290. The light is 4 to the left at
// the height of the hit, so its cosine is the normal's 0.999.
static void a_ray_that_grazes_a_sphere(void **state)
{
    (void)state;
    const Told told = tell(SCENE("light -4 -0.0447102 0 1\nmaterial plain\nsphere 0.999 0 0 1\n"
                                 "camera 0 -5 0 0 0 0 90\n"),
                           2, 2);
    assert_sphere(&told, 0, 1, 4.955290);
    assert_vector(told.rays[0].normal, -0.999, -0.0447102, 0);
    assert_int_equal(told.lights[0].state, LIGHT_SEEN);
    assert_number(told.lights[0].distance, 4);
    assert_number(told.lights[0].cosine, 0.999);
}

// From 0.001 above the floor to a point 4 away, in triangle 0, which is below the diagonal.
static void a_ray_that_grazes_the_floor(void **state)
{
    (void)state;
    const Told told = tell(SCENE("light 1 0 4 1\nmaterial plain\nply_file floor.ply\n"
                                 "camera 1 -4 0.001 1 0 0 90\n"),
                           2, 2);
    assert_floor(&told, 0, 0, 4);
    assert_vector(told.rays[0].point, 1, 0, 0);
    assert_int_equal(told.lights[0].state, LIGHT_SEEN);
    assert_number(told.lights[0].distance, 4);
    assert_number(told.lights[0].cosine, 1);
}

// From the center of a mirror ball. The first ray has length 1, and reflected rays have length 2.
// The wall's normal points outward, away from the light inside.
static void a_mirror_ball_seen_from_inside(void **state)
{
    (void)state;
    const Told told = tell(SCENE("light 0 0 0.5 1\nmaterial mirror\nsphere 0 0 0 1\n"
                                 "camera 0 0 0 0 1 0 90\n"),
                           2, 2);
    assert_int_equal(told.ray_count, 3);
    assert_sphere(&told, 0, 1, 1);
    assert_vector(told.rays[0].normal, 0, 1, 0);
    assert_int_equal(told.lights[0].state, LIGHT_BEHIND);
    assert_sphere(&told, 1, 1, 2);
    assert_vector(told.rays[1].point, 0, -1, 0);
    assert_sphere(&told, 2, 1, 2);
    assert_number(told.color[0], 0.1 * 0.875);
}

// From below, the one-sided floor is invisible. The two-sided floor a unit higher is visible, with
// its normal turned down. The one-sided floor occludes the light a unit below it, because the
// shadow ray meets its front. (1, -2) is in triangle 0 of both.
static void floors_seen_from_below(void **state)
{
    (void)state;
    const Told told = tell(SCENE("light 1 -2 -1 1\nmaterial plain\nply_file floor.ply\nsides two\n"
                                 "mesh floor.ply translate 0 0 1\n"
                                 "up 0 1 0\ncamera 1 -2 -2 1 -2 0 90\n"),
                           2, 2);
    assert_floor(&told, 0, 0, 3);
    assert_int_equal(told.rays[0].primitive, 2);
    assert_vector(told.rays[0].point, 1, -2, 1);
    assert_vector(told.rays[0].normal, 0, 0, -1);
    assert_int_equal(told.lights[0].state, LIGHT_BLOCKED);
    assert_int_equal(told.lights[0].blocker, 0);
    assert_false(told.blockers[0].is_sphere);
    assert_number(told.lights[0].distance, 2);
    assert_number(told.lights[0].blocker_distance, 1);
    assert_number(told.color[0], 0.08);
}

// The light is 10 beside and 5 below the point. The normal (0.6, 0, 0.8) faces it at the cosine
// (0.6 * 10 - 0.8 * 5) / sqrt(125). The face points up, away from the light.
static void a_face_turned_away_from_a_light(void **state)
{
    (void)state;
    const Told told = tell(SCENE("light 11 -2 -5 1\nmaterial plain\nply_file leaning.ply\n"
                                 "up 0 1 0\ncamera 1 -2 4 1 -2 0 90\n"),
                           2, 2);
    assert_floor(&told, 0, 0, 4);
    assert_vector(told.rays[0].normal, 0.6, 0, 0.8);
    assert_int_equal(told.lights[0].state, LIGHT_BEHIND_FACE);
    assert_number(told.lights[0].cosine, 0.178885);
    assert_number(told.lights[0].distance, 11.180340);
    assert_number(told.color[0], 0.08);
}

static int make_folder(void **state)
{
    char path[96];
    (void)state;
    snprintf(folder, sizeof folder, "/tmp/clrt-explain-XXXXXX");
    if (mkdtemp(folder) == NULL)
        return -1;
    write_file("floor.ply", floor_text, path);
    write_file("leaning.ply", leaning_text, path);
    return 0;
}

static int remove_folder(void **state)
{
    char path[96];
    (void)state;
    snprintf(path, sizeof path, "%s/floor.ply", folder);
    unlink(path);
    snprintf(path, sizeof path, "%s/leaning.ply", folder);
    unlink(path);
    snprintf(path, sizeof path, "%s/scene.scn", folder);
    unlink(path);
    return rmdir(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sphere_seen_head_on),
        cmocka_unit_test(a_ray_past_the_sphere),
        cmocka_unit_test(a_point_under_a_ball),
        cmocka_unit_test(a_point_just_inside_a_shadows_edge),
        cmocka_unit_test(a_point_just_outside_a_shadows_edge),
        cmocka_unit_test(a_mirror_of_a_mirror_of_a_mirror),
        cmocka_unit_test(a_ray_that_grazes_a_sphere),
        cmocka_unit_test(a_ray_that_grazes_the_floor),
        cmocka_unit_test(a_mirror_ball_seen_from_inside),
        cmocka_unit_test(floors_seen_from_below),
        cmocka_unit_test(a_face_turned_away_from_a_light),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
