// SPDX-License-Identifier: MIT
// The layout of nodes, the tree, and the order of triangles in the file do not change a bit of the
// picture.
#include "support/random.h"
#include "support/varied_scene.h"

#include <string.h>

#define SIZE 96

static void every_layout_of_nodes_draws_the_same_picture_t28(void **state)
{
    static const struct {
        const char *name;
        KernelChoice choice;
        uint32_t group;
    } layouts[] = {{"pair", {FAMILY_RAY, NODES_PAIR, 0, PRECISION_FP32}, 8},
                   {"wide", {FAMILY_RAY, NODES_WIDE, 0, PRECISION_FP32}, 2},
                   {"packet", {FAMILY_PACKET, NODES_WIDE, 0, PRECISION_FP32}, 2}};
    PictureSettings settings = picture_settings(SIZE);
    Framebuffer usual = varied_picture(*state, &settings);
    for (size_t i = 0; i < COUNT(layouts); i++) {
        settings.choice = layouts[i].choice;
        settings.render.group_width = settings.render.group_height = layouts[i].group;
        outcome_report(picture_compare("T-28", &usual, varied_picture(*state, &settings)),
                       "kernel=%s", layouts[i].name);
    }
    framebuffer_free(&usual);
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
    Outcome sum = {0};
    Random random = {29};
    const size_t permutations = tier_size(5, 100);
    const PictureSettings settings = picture_settings(SIZE);
    Framebuffer usual = varied_picture(*state, &settings);
    for (size_t i = 0; i < permutations; i++) {
        Scene scene = varied_scene();
        for (size_t object = 0; object < scene.objects.count; object++)
            permute_triangles(&scene.objects.data[object].mesh, &random);
        const Framebuffer other = picture_draw_once(*state, scene, &settings);
        outcome_add(&sum, picture_compare("T-29", &usual, other));
    }
    framebuffer_free(&usual);
    outcome_report(sum, "permutations=%zu", permutations);
}

static void every_tree_and_size_of_leaf_draws_the_same_picture_t30(void **state)
{
    PictureSettings settings = picture_settings(SIZE);
    Framebuffer usual = varied_picture(*state, &settings);
    for (settings.tree = TREE_MIDPOINT; settings.tree < TREE_ALL_KINDS; settings.tree++)
        outcome_report(picture_compare("T-30", &usual, varied_picture(*state, &settings)),
                       "tree=%s", tree_names[settings.tree]);
    framebuffer_free(&usual);
}

RUN_TESTS(picture_setup, picture_teardown,
          EXTREME(every_layout_of_nodes_draws_the_same_picture_t28),
          EXTREME(the_order_of_triangles_in_the_file_changes_no_picture_t29),
          EXTREME(every_tree_and_size_of_leaf_draws_the_same_picture_t30))
