// SPDX-License-Identifier: MIT
// However triangles are stored - in which nodes, by which tree, in which order in the file - the
// picture is the same, bit by bit.
#include "support/check.h"
#include "support/picture.h"
#include "support/random.h"
#include "support/report.h"
#include "support/shapes.h"
#include "support/tier.h"
#include "support/varied_scene.h"

#include <string.h>

#define SIZE 96

static PictureSettings sized_settings(void)
{
    PictureSettings settings = picture_settings();
    settings.render.width = settings.render.height = SIZE;
    return settings;
}

static void draw_varied(Framebuffer *picture, const Studio *studio, const PictureSettings *settings)
{
    Scene scene = varied_scene();
    picture_draw(picture, studio, &scene, settings);
    scene_free(&scene);
}

static size_t differences_from(const Framebuffer *usual, const Studio *studio,
                               const PictureSettings *settings)
{
    Framebuffer other;
    draw_varied(&other, studio, settings);
    const size_t differences = picture_count_differences(usual, &other);
    framebuffer_free(&other);
    return differences;
}

static void every_layout_of_nodes_draws_the_same_picture_t28(void **state)
{
    static const struct {
        const char *name;
        KernelChoice choice;
        uint32_t group;
    } layouts[] = {{"pair", {FAMILY_RAY, NODES_PAIR, 0, PRECISION_FP32}, 8},
                   {"wide", {FAMILY_RAY, NODES_WIDE, 0, PRECISION_FP32}, 2},
                   {"packet", {FAMILY_PACKET, NODES_WIDE, 0, PRECISION_FP32}, 2}};
    Framebuffer usual;
    size_t differences = 0;
    PictureSettings settings = sized_settings();
    draw_varied(&usual, *state, &settings);
    for (size_t i = 0; i < sizeof layouts / sizeof *layouts; i++) {
        char details[32];
        settings.choice = layouts[i].choice;
        settings.render.group_width = settings.render.group_height = layouts[i].group;
        snprintf(details, sizeof details, "kernel=%s", layouts[i].name);
        differences +=
            report_case("T-28", details, SIZE * SIZE, differences_from(&usual, *state, &settings));
    }
    framebuffer_free(&usual);
    assert_int_equal(differences, 0);
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

static void the_order_of_triangles_in_the_file_changes_no_picture_t29(void **state)
{
    Framebuffer usual;
    char details[32];
    Random random = {29};
    size_t differences = 0;
    const size_t permutations = tier_size(5, 100);
    const PictureSettings settings = sized_settings();
    draw_varied(&usual, *state, &settings);
    for (size_t i = 0; i < permutations; i++) {
        Framebuffer other;
        Scene scene = varied_scene();
        for (size_t object = 0; object < scene.objects.count; object++)
            permute_triangles(&scene.objects.data[object].mesh, &random);
        picture_draw(&other, *state, &scene, &settings);
        differences += picture_count_differences(&usual, &other);
        framebuffer_free(&other);
        scene_free(&scene);
    }
    framebuffer_free(&usual);
    snprintf(details, sizeof details, "permutations=%zu", permutations);
    report_case("T-29", details, permutations * SIZE * SIZE, differences);
    assert_int_equal(differences, 0);
}

static void every_tree_and_size_of_leaf_draws_the_same_picture_t30(void **state)
{
    Framebuffer usual;
    size_t differences = 0;
    PictureSettings settings = sized_settings();
    draw_varied(&usual, *state, &settings);
    for (settings.tree = TREE_MIDPOINT; settings.tree < TREE_ALL_KINDS; settings.tree++) {
        char details[32];
        snprintf(details, sizeof details, "tree=%s", tree_names[settings.tree]);
        differences +=
            report_case("T-30", details, SIZE * SIZE, differences_from(&usual, *state, &settings));
    }
    framebuffer_free(&usual);
    assert_int_equal(differences, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_layout_of_nodes_draws_the_same_picture_t28),
        cmocka_unit_test(the_order_of_triangles_in_the_file_changes_no_picture_t29),
        cmocka_unit_test(every_tree_and_size_of_leaf_draws_the_same_picture_t30),
    };
    return cmocka_run_group_tests(tests, picture_setup, picture_teardown);
}
