// SPDX-License-Identifier: MIT
// Moving the whole scene does not change a bit of the picture. Mirroring it or exchanging its axes
// changes only rounding.
#include "support/shapes.h"
#include "support/varied_scene.h"

typedef struct {
    int axis[3];    // the old axis that becomes each new one
    double sign[3]; // of the new axes
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

static void move_mesh(Mesh *mesh, const Motion *motion)
{
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        shape_set_vertex(mesh, i, moved(motion, shape_vertex(mesh, i)));
        if (mesh->normals != NULL)
            shape_store(mesh->normals[i], moved_direction(motion, vec3_of(mesh->normals[i])));
    }
    if (motion->sign[0] * motion->sign[1] * motion->sign[2] < 0)
        shape_flip(mesh);
}

static void move_scene(Scene *scene, const Motion *motion)
{
    for (size_t i = 0; i < scene->objects.count; i++)
        move_mesh(&scene->objects.data[i].mesh, motion);
    for (size_t i = 0; i < scene->spheres.count; i++)
        scene->spheres.data[i].center = moved(motion, scene->spheres.data[i].center);
    for (size_t i = 0; i < scene->lights.count; i++)
        scene->lights.data[i].position = moved(motion, scene->lights.data[i].position);
    Viewpoint *view = &scene->viewpoints.data[0];
    view->eye = moved(motion, view->eye);
    view->look_at = moved(motion, view->look_at);
    view->up = moved_direction(motion, view->up);
}

// Returns the varied scene with all vertices at multiples of 1/8.
static Scene lattice_scene(void)
{
    Scene scene = varied_scene();
    for (size_t i = 0; i < scene.objects.count; i++) {
        Mesh *mesh = &scene.objects.data[i].mesh;
        for (size_t vertex = 0; vertex < mesh->vertex_count; vertex++)
            for (int axis = 0; axis < 3; axis++)
                mesh->positions[vertex][axis] = rint(8 * mesh->positions[vertex][axis]) / 8;
    }
    return scene;
}

static void a_scene_moved_by_integers_gives_the_same_picture_bit_by_bit_t49(void **state)
{
    static const Vec3 moves[] = {{1, 2, 3}, {-1000, 77, 12345}, {0x1p20, -0x1p19, 0x1p18}};
    const PictureSettings settings = picture_settings(64);
    Framebuffer usual = picture_draw_once(*state, lattice_scene(), &settings);
    for (size_t i = 0; i < COUNT(moves); i++) {
        const Motion motion = {{0, 1, 2}, {1, 1, 1}, moves[i]};
        Scene scene = lattice_scene();
        move_scene(&scene, &motion);
        outcome_report(picture_compare("T-49", &usual, picture_draw_once(*state, scene, &settings)),
                       "move=%g,%g,%g", moves[i].x, moves[i].y, moves[i].z);
    }
    framebuffer_free(&usual);
}

// Returns how many pixels differ by more than a display shows, which means another decision. *rmse
// becomes the root mean square difference of the other pixels.
static size_t count_decisions(const Framebuffer *usual, const Framebuffer *other, bool is_mirrored,
                              double *rmse)
{
    size_t decisions = 0;
    double squares = 0;
    const uint32_t width = usual->width;
    for (size_t pixel = 0; pixel < picture_pixels(usual); pixel++) {
        const size_t x = pixel % width, from = is_mirrored ? width - 1 - x : x;
        const float *a = usual->pixels[pixel], *b = other->pixels[pixel - x + from];
        const Vec3 apart = vec3_sub(vec3_of(a), vec3_of(b));
        const bool differs = vec3_extent(apart) > 1.0 / 255;
        decisions += differs;
        squares += differs ? 0 : vec3_dot(apart, apart);
    }
    *rmse = sqrt(squares / (3.0 * (double)picture_pixels(usual)));
    return decisions;
}

static void a_scene_mirrored_or_turned_by_its_axes_looks_the_same_t50(void **state)
{
    static const struct {
        const char *name;
        Motion motion;
        bool is_mirrored;
    } motions[] = {{"mirror_x", {{0, 1, 2}, {-1, 1, 1}, {0, 0, 0}}, true},
                   {"mirror_z", {{0, 1, 2}, {1, 1, -1}, {0, 0, 0}}, true},
                   {"axes_yzx", {{1, 2, 0}, {1, 1, 1}, {0, 0, 0}}, false},
                   {"axes_zxy", {{2, 0, 1}, {1, 1, 1}, {0, 0, 0}}, false}};
    const PictureSettings settings = picture_settings((uint32_t)tier_size(64, 512));
    Framebuffer usual = varied_picture(*state, &settings);
    for (size_t i = 0; i < COUNT(motions); i++) {
        double rmse;
        Scene scene = varied_scene();
        move_scene(&scene, &motions[i].motion);
        Framebuffer other = picture_draw_once(*state, scene, &settings);
        const size_t decisions = count_decisions(&usual, &other, motions[i].is_mirrored, &rmse);
        outcome_report(outcome_of("T-50", picture_pixels(&usual), decisions + (rmse > 1e-6)),
                       "motion=%s rmse=%.2g", motions[i].name, rmse);
        framebuffer_free(&other);
    }
    framebuffer_free(&usual);
}

RUN_TESTS(picture_setup, picture_teardown,
          EXTREME(a_scene_moved_by_integers_gives_the_same_picture_bit_by_bit_t49),
          EXTREME(a_scene_mirrored_or_turned_by_its_axes_looks_the_same_t50))
