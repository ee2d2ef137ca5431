// SPDX-License-Identifier: MIT
// In one precision, a scene must give the same bits regardless of the kernels' form and
// specialization, the tree, the tiles and the work-groups.
#include "image/form.h"
#include "image/rendered.h"
#include "unit/cmocka_all.h"

#include <stdio.h>

static const char *const scenes[] = {
    CLRT_SOURCE_FOLDER "/scenes/reflections.scn",
    CLRT_SOURCE_FOLDER "/scenes/blinn_phong.scn",
    CLRT_SOURCE_FOLDER "/scenes/simple.scn",
    CLRT_SOURCE_FOLDER "/tests/image/every_feature.scn",
    CLRT_SOURCE_FOLDER "/tests/image/painted.scn",
    CLRT_SOURCE_FOLDER "/tests/image/orthographic.scn",
};
#define SCENE_COUNT (sizeof scenes / sizeof scenes[0])

// Both sides are prime, so few tiles or work-groups divide the picture.
static PictureRequest small_request(size_t scene)
{
    PictureRequest request = picture_request(scenes[scene], 1);
    request.width = 131;
    request.height = 97;
    request.samples = 2;
    return request;
}

TEST(every_form_and_tree_draws_the_same)
{
    for (size_t scene = 0; scene < SCENE_COUNT; scene++)
        rendered_expect_same_with_every_tree(small_request(scene));
}

// test_hashes draws glass in every form.
TEST(every_tree_draws_the_same_glass)
{
    const PictureRequest glass = picture_request(CLRT_SOURCE_FOLDER "/tests/image/glass.scn", 1);
    PictureRequest usual = rendered_in_form(glass, &form_all[0]), others[2];
    usual.width = 131;
    usual.height = 97;
    others[0] = others[1] = usual;
    others[0].builder = BVH_MIDPOINT;
    others[0].tile_width = 13;
    others[0].tile_height = 7;
    others[1].uses_bvh = false;
    rendered_expect_same(&usual, others, 2);
}

TEST(every_form_draws_pictures_of_a_few_pixels)
{
    static const uint32_t sizes[][2] = {{1, 1}, {1, 5}, {3, 2}, {9, 1}};
    for (size_t size = 0; size < sizeof sizes / sizeof sizes[0]; size++) {
        PictureRequest usual = small_request(SCENE_COUNT - 1), others[FORMS_FP32];
        usual.width = sizes[size][0];
        usual.height = sizes[size][1];
        for (size_t i = 0; i < FORMS_FP32; i++)
            others[i] = rendered_in_form(usual, &form_all[i]);
        rendered_expect_same(&others[0], &others[1], FORMS_FP32 - 1);
    }
}

// PoCL compiles the kernels for each size of work-groups, so this test draws only one scene.
TEST(every_size_of_tiles_and_work_groups_draws_the_same)
{
    static const uint32_t tiles[][2] = {{8, 8}, {7, 5}, {131, 1}, {1000, 33}, {64, 1000}, {2, 3}};
    static const uint32_t groups[][2] = {{1, 1}, {3, 5}, {16, 16}, {1, 64}};
    enum { TILES = sizeof tiles / sizeof tiles[0], GROUPS = sizeof groups / sizeof groups[0] };
    const PictureRequest usual = small_request(SCENE_COUNT - 1);
    PictureRequest others[TILES + GROUPS];
    for (size_t i = 0; i < TILES + GROUPS; i++) {
        others[i] = usual;
        if (i < TILES) {
            others[i].tile_width = tiles[i][0];
            others[i].tile_height = tiles[i][1];
        } else {
            others[i].group_width = groups[i - TILES][0];
            others[i].group_height = groups[i - TILES][1];
        }
    }
    rendered_expect_same(&usual, others, TILES + GROUPS);
}

// The sizes of a GPU's launches depend on its compute units and on measured times.
TEST(every_size_of_gpu_launches_draws_the_same)
{
    static const uint32_t units[] = {1, 2, 132};
    static const uint32_t tiles[][2] = {{128, 128}, {8, 8}, {7, 50}, {131, 1}, {1000, 1000}};
    enum { UNITS = sizeof units / sizeof units[0], TILES = sizeof tiles / sizeof tiles[0] };
    const PictureRequest usual = rendered_in_form(small_request(SCENE_COUNT - 1), &form_all[0]);
    PictureRequest others[UNITS * TILES];
    for (size_t i = 0; i < UNITS * TILES; i++) {
        others[i] = usual;
        others[i].gpu_units = units[i / TILES];
        others[i].tile_width = tiles[i % TILES][0];
        others[i].tile_height = tiles[i % TILES][1];
    }
    rendered_expect_same(&usual, others, UNITS * TILES);
}

// Writes a scene with exactly the features of the mask, and returns its path.
static const char *write_scene(unsigned mask)
{
    static char path[TEMPORARY_PATH];
    FILE *stream = temporary_open(path);
    fprintf(stream, "light 3 -4 6 .8\ndefine it %s reflectivity %s\nmaterial it\n",
            mask & 4 ? "blinn_phong" : "silhouette", mask & 8 ? ".4" : "0");
    if (mask & 1)
        fprintf(stream, "sphere -.4 .3 .4 .4\nsphere .5 .3 .3 .3\n");
    if (mask & 2)
        fprintf(stream, "ply_file %s/scenes/cube.ply\nply_file %s/scenes/plateau.ply\n",
                CLRT_SOURCE_FOLDER, CLRT_SOURCE_FOLDER);
    temporary_close(stream);
    return path;
}

// Tests one setting of six switches: the mask's four features, the tree and the statistics.
static void expect_special_same(unsigned mask, const KernelChoice *choice)
{
    uint64_t tallies[TALLY_KINDS];
    PictureRequest general = rendered_in_form(picture_request(write_scene(mask & 15), 1), choice);
    general.width = general.height = 40;
    general.uses_bvh = (mask & 16) != 0;
    PictureRequest special = general;
    special.specialization = CLRT_SPECIALIZE_ALWAYS;
    special.tallies = mask & 32 ? tallies : NULL;
    rendered_expect_same(&general, &special, 1);
    remove(general.scene_path);
}

// Rays and packets share the code of most switches. Kernels of rays compile sooner, so only these
// are tested with all four combinations of every two switches (Kleitman and Spencer, "Families of
// k-independent sets", 1973). A mask with all switches would give almost the general program.
TEST(specialized_rays_draw_the_general_rays_picture)
{
    static const unsigned masks[] = {0, 39, 11, 21, 58, 60};
    for (size_t i = 0; i < sizeof masks / sizeof masks[0]; i++)
        expect_special_same(masks[i], &form_all[0]);
}

// Packets have their own code for spheres, triangles and trees.
TEST(specialized_packets_draw_the_general_packets_picture)
{
    const KernelChoice packet = {FAMILY_PACKET, NODES_WIDE, 0, CLRT_FP32};
    expect_special_same(0, &packet);
    expect_special_same(63u & ~1u, &packet);
    expect_special_same(63u & ~2u, &packet);
    expect_special_same(63u & ~16u, &packet);
}

TEST(fp64_draws_the_same_whatever_the_tree_the_tiles_and_the_work_groups)
{
    const PictureRequest sah =
        rendered_in_form(small_request(SCENE_COUNT - 1), &form_all[FORMS_FP32]);
    PictureRequest others[] = {sah, sah, sah};
    others[0].builder = BVH_MIDPOINT;
    others[0].tile_width = 13;
    others[1].uses_bvh = false;
    others[1].group_width = others[1].group_height = 1;
    others[2].group_width = 3;
    others[2].group_height = 5;
    rendered_expect_same(&sah, others, 3);
}

TEST(specialized_fp64_kernels_draw_the_general_kernels_picture)
{
    expect_special_same(0, &form_all[FORMS_FP32]);
    expect_special_same(63, &form_all[FORMS_FP32]);
}
