// SPDX-License-Identifier: MIT
// A scene moved as a whole is the same scene, bit by bit; one mirrored or with its axes exchanged
// is the same up to rounding.
#include "support/check.h"
#include "support/picture.h"
#include "support/random.h"
#include "support/report.h"
#include "support/shapes.h"
#include "support/tier.h"
#include "support/varied_scene.h"

typedef struct {
    int axis[3];    // which old axis becomes each new one
    double sign[3]; // and with which sign
    Vec3 move;
} Motion;

static Vec3 moved(const Motion *motion, Vec3 point)
{
    const double old[3] = {point.x, point.y, point.z};
    const Vec3 turned = {motion->sign[0] * old[motion->axis[0]],
                         motion->sign[1] * old[motion->axis[1]],
                         motion->sign[2] * old[motion->axis[2]]};
    return vec3_add(turned, motion->move);
}

static Vec3 moved_direction(const Motion *motion, Vec3 direction)
{
    return vec3_sub(moved(motion, direction), motion->move);
}

static void move_mesh(Mesh *mesh, const Motion *motion, bool flips)
{
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        double *p = mesh->positions[i];
        const Vec3 place = moved(motion, vec3(p[0], p[1], p[2]));
        p[0] = place.x;
        p[1] = place.y;
        p[2] = place.z;
        if (mesh->normals == NULL)
            continue;
        float *n = mesh->normals[i];
        const Vec3 normal = moved_direction(motion, vec3((double)n[0], (double)n[1], (double)n[2]));
        n[0] = (float)normal.x;
        n[1] = (float)normal.y;
        n[2] = (float)normal.z;
    }
    for (size_t i = 0; i < mesh->triangle_count && flips; i++) {
        const uint32_t second = mesh->triangles[i][1];
        mesh->triangles[i][1] = mesh->triangles[i][2];
        mesh->triangles[i][2] = second;
    }
}

static void move_scene(Scene *scene, const Motion *motion)
{
    const bool flips = motion->sign[0] * motion->sign[1] * motion->sign[2] < 0;
    for (size_t i = 0; i < scene->objects.count; i++)
        move_mesh(&scene->objects.data[i].mesh, motion, flips);
    for (size_t i = 0; i < scene->spheres.count; i++)
        scene->spheres.data[i].center = moved(motion, scene->spheres.data[i].center);
    for (size_t i = 0; i < scene->lights.count; i++)
        scene->lights.data[i].position = moved(motion, scene->lights.data[i].position);
    Viewpoint *view = &scene->viewpoints.data[0];
    view->eye = moved(motion, view->eye);
    view->look_at = moved(motion, view->look_at);
    view->up = moved_direction(motion, view->up);
}

static double on_lattice(double value)
{
    return rint(8 * value) / 8;
}

// All of the varied scene on a lattice of eighths.
static Scene lattice_scene(void)
{
    Scene scene = varied_scene();
    for (size_t i = 0; i < scene.objects.count; i++) {
        Mesh *mesh = &scene.objects.data[i].mesh;
        for (size_t vertex = 0; vertex < mesh->vertex_count; vertex++)
            for (int axis = 0; axis < 3; axis++)
                mesh->positions[vertex][axis] = on_lattice(mesh->positions[vertex][axis]);
    }
    return scene;
}

static void a_scene_moved_by_integers_gives_the_same_picture_bit_by_bit_t49(void **state)
{
    static const Vec3 moves[] = {{1, 2, 3}, {-1000, 77, 12345}, {0x1p20, -0x1p19, 0x1p18}};
    Framebuffer usual;
    size_t differences = 0;
    const PictureSettings settings = picture_settings();
    Scene unmoved = lattice_scene();
    picture_draw(&usual, *state, &unmoved, &settings);
    scene_free(&unmoved);
    for (size_t i = 0; i < sizeof moves / sizeof *moves; i++) {
        char details[64];
        Framebuffer other;
        const Motion motion = {{0, 1, 2}, {1, 1, 1}, moves[i]};
        Scene scene = lattice_scene();
        move_scene(&scene, &motion);
        picture_draw(&other, *state, &scene, &settings);
        snprintf(details, sizeof details, "move=%g,%g,%g", moves[i].x, moves[i].y, moves[i].z);
        differences += report_case("T-49", details, (size_t)usual.width * usual.height,
                                   picture_count_differences(&usual, &other));
        framebuffer_free(&other);
        scene_free(&scene);
    }
    framebuffer_free(&usual);
    assert_int_equal(differences, 0);
}

// Pixels that differ by more than a display shows decide something else; the others' root mean
// square goes to *rmse.
static size_t compare(const Framebuffer *usual, const Framebuffer *other, bool mirrored,
                      double *rmse)
{
    size_t decisions = 0;
    double squares = 0;
    const uint32_t width = usual->width;
    for (uint32_t y = 0; y < usual->height; y++)
        for (uint32_t x = 0; x < width; x++) {
            const uint32_t from = mirrored ? width - 1 - x : x;
            const float *a = usual->pixels[(size_t)y * width + x];
            const float *b = other->pixels[(size_t)y * width + from];
            double largest = 0, sum = 0;
            for (int channel = 0; channel < 3; channel++) {
                const double apart = (double)a[channel] - (double)b[channel];
                largest = fmax(largest, fabs(apart));
                sum += apart * apart;
            }
            decisions += largest > 1.0 / 255;
            squares += largest > 1.0 / 255 ? 0 : sum;
        }
    *rmse = sqrt(squares / (3.0 * width * usual->height));
    return decisions;
}

static void a_scene_mirrored_or_turned_by_its_axes_looks_the_same_t50(void **state)
{
    static const struct {
        const char *name;
        Motion motion;
        bool mirrored;
    } motions[] = {{"mirror_x", {{0, 1, 2}, {-1, 1, 1}, {0, 0, 0}}, true},
                   {"mirror_z", {{0, 1, 2}, {1, 1, -1}, {0, 0, 0}}, true},
                   {"axes_yzx", {{1, 2, 0}, {1, 1, 1}, {0, 0, 0}}, false},
                   {"axes_zxy", {{2, 0, 1}, {1, 1, 1}, {0, 0, 0}}, false}};
    Framebuffer usual;
    size_t wrong = 0;
    PictureSettings settings = picture_settings();
    settings.render.width = settings.render.height = (uint32_t)tier_size(64, 512);
    Scene unmoved = varied_scene();
    picture_draw(&usual, *state, &unmoved, &settings);
    scene_free(&unmoved);
    for (size_t i = 0; i < sizeof motions / sizeof *motions; i++) {
        double rmse;
        char details[64];
        Framebuffer other;
        Scene scene = varied_scene();
        move_scene(&scene, &motions[i].motion);
        picture_draw(&other, *state, &scene, &settings);
        const size_t decisions = compare(&usual, &other, motions[i].mirrored, &rmse);
        snprintf(details, sizeof details, "motion=%s rmse=%.2g", motions[i].name, rmse);
        wrong += report(&(Case){.test = "T-50",
                                .details = details,
                                .rays = (size_t)usual.width * usual.height,
                                .fail = decisions + (rmse > 1e-6),
                                .limit = 0});
        framebuffer_free(&other);
        scene_free(&scene);
    }
    framebuffer_free(&usual);
    assert_int_equal(wrong, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_scene_moved_by_integers_gives_the_same_picture_bit_by_bit_t49),
        cmocka_unit_test(a_scene_mirrored_or_turned_by_its_axes_looks_the_same_t50),
    };
    return cmocka_run_group_tests(tests, picture_setup, picture_teardown);
}
