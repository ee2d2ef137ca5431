// SPDX-License-Identifier: MIT
// A picture's bits must not depend on the scene's size and place, the handling of denormals, the
// order of parts and triangles, or the tree. image/test_identity.c varies kernels and work-groups.
#include "support/random_points.h"
#include "support/shapes.h"
#include "support/varied_scene.h"

#include <string.h>

#define SIZE 96

static PictureSettings usual_settings(void)
{
    PictureSettings settings = picture_settings(SIZE);
    settings.render.samples = 2;
    return settings;
}

// Compares the bits of a scene's picture with the bits of `usual`. Frees the scene.
static Outcome compare(const char *test, const Studio *studio, const Framebuffer *usual,
                       Scene scene)
{
    const PictureSettings settings = usual_settings();
    return picture_compare(test, usual, picture_draw_once(studio, scene, &settings));
}

static Framebuffer usual_picture(const Studio *studio, Scene scene)
{
    const PictureSettings settings = usual_settings();
    const Framebuffer usual = picture_draw_once(studio, scene, &settings);
    assert_int_equal(picture_count_faults(&usual), 0);
    return usual;
}

static void permute_triangles(Mesh *mesh, Random *random)
{
    for (size_t i = mesh->triangle_count - 1; i > 0; i--) {
        uint32_t kept[3];
        const size_t other = random_below(random, (uint32_t)i + 1);
        memcpy(kept, mesh->triangles[i], sizeof kept);
        memcpy(mesh->triangles[i], mesh->triangles[other], sizeof kept);
        memcpy(mesh->triangles[other], kept, sizeof kept);
    }
}

EXTREME(permuted_triangles_draw_the_same_picture_t29)
{
    Outcome sum = {0};
    Random random = {29};
    const size_t permutations = tier_size(5, 100);
    FREED_BY(framebuffer_free) Framebuffer usual = usual_picture(*state, varied_scene());
    for (size_t i = 0; i < permutations; i++) {
        Scene scene = varied_scene();
        for (size_t object = 0; object < scene.objects.count; object++)
            permute_triangles(&scene.objects.data[object].mesh, &random);
        outcome_add(&sum, compare("T-29", *state, &usual, scene));
    }
    outcome_report(sum, "permutations=%zu", permutations);
}

static void turn_corners(Mesh *mesh, Random *random)
{
    for (size_t i = 0; i < mesh->triangle_count; i++)
        for (uint32_t turns = random_below(random, 3); turns > 0; turns--) {
            uint32_t *corners = mesh->triangles[i];
            const uint32_t first = corners[0];
            memmove(corners, corners + 1, 2 * sizeof *corners);
            corners[2] = first;
        }
}

EXTREME(turned_corners_and_copies_in_any_order_draw_the_same_picture_t13)
{
    Outcome sum = {0};
    Random random = {13};
    FREED_BY(framebuffer_free) Framebuffer usual = usual_picture(*state, varied_scene());
    for (int i = 0; i < 3; i++) {
        Scene scene = varied_scene(), copy = varied_scene();
        for (size_t object = 0; object < copy.objects.count; object++) {
            turn_corners(&scene.objects.data[object].mesh, &random);
            shape_add(&scene, shape_reordered(copy.objects.data[object].mesh, &random), 1);
        }
        copy.objects.count = 0; // scene owns the copy's meshes
        scene_free(&copy);
        outcome_add(&sum, compare("T-13", *state, &usual, scene));
    }
    outcome_report(sum, "copies=3");
}

EXTREME(every_tree_and_size_of_leaf_draws_the_same_picture_t30)
{
    PictureSettings settings = usual_settings();
    FREED_BY(framebuffer_free) Framebuffer usual = usual_picture(*state, varied_scene());
    for (settings.tree = TREE_MIDPOINT; settings.tree < TREE_ALL_KINDS; settings.tree++)
        outcome_report(
            picture_compare("T-30", &usual, picture_draw_once(*state, varied_scene(), &settings)),
            "tree=%s", tree_names[settings.tree]);
}

EXTREME(a_scene_of_any_size_gives_the_same_picture_t46)
{
    FREED_BY(framebuffer_free) Framebuffer usual = usual_picture(*state, varied_scene());
    for (int exponent = -60; exponent <= 60; exponent += tier() == 0 ? 15 : 1) {
        Scene scene = varied_scene();
        varied_scene_place(&scene, ldexp(1, exponent), vec3(0, 0, 0));
        outcome_report(compare("T-46", *state, &usual, scene), "k=%d", exponent);
    }
}

EXTREME(flushing_denormals_to_zero_changes_no_picture_t47)
{
    PictureSettings settings = usual_settings();
    settings.extra_options = "-cl-denorms-are-zero";
    FREED_BY(framebuffer_free) Framebuffer usual = usual_picture(*state, varied_scene());
    outcome_report(
        picture_compare("T-47", &usual, picture_draw_once(*state, varied_scene(), &settings)),
        "option=%s", settings.extra_options);
}

// The hash of varied_scene's picture, which is equal on every device and for every PoCL target of
// tests/extremes/CMakeLists.txt.
#define PICTURE_ON_RECORD "ec5c80aa50c8f17918c2bed9c22cfbeb"

EXTREME(the_picture_is_the_one_on_record_t48)
{
    char hash[FRAMEBUFFER_HASH_SIZE];
    const char *target = getenv("CLRT_TEST_TARGET");
    FREED_BY(framebuffer_free) Framebuffer picture = usual_picture(*state, varied_scene());
    framebuffer_hash(&picture, hash);
    outcome_report(outcome_of("T-48", SIZE * SIZE, strcmp(hash, PICTURE_ON_RECORD) != 0),
                   "target=%s hash=%s", target != NULL ? target : "usual", hash);
}

#define PARTS 9

// Draws the part that the renderer's settings select, and copies its tiles to their places in the
// picture.
static void draw_part(Renderer *renderer, const CameraData *camera, Framebuffer *picture)
{
    const RenderSettings *settings = &renderer->settings;
    FREED_BY(framebuffer_free) Framebuffer part;
    uint32_t width, height;
    Error error = {0};
    tile_frame_size(settings, &width, &height);
    require(framebuffer_make(&part, width, height, &error), &error);
    require(tile_pass_draw(renderer, camera, NULL, &part, &error), &error);
    for (uint64_t number = 0; number < tile_count(settings); number++) {
        const Tile tile = tile_at(settings, number);
        for (uint32_t row = 0; row < tile.height; row++)
            memcpy(picture->pixels[(tile.y + row) * SIZE + tile.x],
                   part.pixels[(tile.top + row) * width + tile.left],
                   tile.width * sizeof *part.pixels);
    }
}

static Framebuffer draw_shuffled(const Studio *studio, Random *random)
{
    OpenPicture open;
    Error error = {0};
    Framebuffer picture;
    uint32_t order[PARTS] = {0};
    PictureSettings settings = usual_settings();
    settings.render.tile_width = settings.render.tile_height = 32;
    FREED_BY(scene_free) Scene scene = varied_scene();
    const CameraData camera = picture_camera(&scene, &settings.render);
    picture_open(&open, studio, &scene, &settings);
    require(framebuffer_make(&picture, SIZE, SIZE, &error), &error);
    open.renderer.settings.parts = PARTS;
    for (uint32_t i = 0; i < PARTS; i++) {
        const uint32_t other = random_below(random, i + 1);
        order[i] = order[other];
        order[other] = i;
    }
    for (uint32_t i = 0; i < PARTS; i++) {
        open.renderer.settings.part = order[i];
        draw_part(&open.renderer, &camera, &picture);
    }
    picture_close(&open);
    return picture;
}

EXTREME(parts_in_any_order_draw_the_same_picture_t48)
{
    Random random = {48};
    FREED_BY(framebuffer_free) Framebuffer usual = usual_picture(*state, varied_scene());
    for (int i = 0; i < 4; i++)
        outcome_report(picture_compare("T-48", &usual, draw_shuffled(*state, &random)), "order=%d",
                       i);
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

EXTREME(a_scene_moved_by_integers_gives_the_same_picture_t49)
{
    static const Vec3 moves[] = {{1, 2, 3}, {-1000, 77, 12345}, {0x1p20, -0x1p19, 0x1p18}};
    FREED_BY(framebuffer_free) Framebuffer usual = usual_picture(*state, lattice_scene());
    for (size_t i = 0; i < COUNT(moves); i++) {
        Scene scene = lattice_scene();
        varied_scene_place(&scene, 1, moves[i]);
        outcome_report(compare("T-49", *state, &usual, scene), "move=%g,%g,%g", moves[i].x,
                       moves[i].y, moves[i].z);
    }
}

FIXTURES(picture_setup, picture_teardown)
