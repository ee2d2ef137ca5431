// SPDX-License-Identifier: MIT
// Tests that libclrt renders the same bits as the program and fulfills clrt.h.
#include "library/filled.h"
#include "library/renderer.h"

#include <stdlib.h>
#include <string.h>

#define TILE 128

static ClrtScene *load(const char *path)
{
    ClrtError error;
    ClrtScene *scene = clrt_scene_load(path, NULL, &error);
    if (scene == NULL)
        fail_msg("%s", error.text);
    return scene;
}

static float *make_buffer(const ClrtPicture *picture)
{
    float *rgb = malloc(3 * (size_t)picture->width * picture->height * sizeof *rgb);
    assert_non_null(rgb);
    return rgb;
}

static float *draw(const ClrtScene *scene, const ClrtPicture *picture)
{
    ClrtError error;
    float *rgb = make_buffer(picture);
    if (!clrt_render(renderer, scene, picture, rgb, &error))
        fail_msg("%s", error.text);
    return rgb;
}

// Expects the program's picture of the file with these options. Frees the scene.
static void expect_program(ClrtScene *scene, const char *file, const char *options,
                           ClrtPicture picture)
{
    picture.size = sizeof picture;
    float *expected = program_draw(program_file(file), options, picture.width, picture.height);
    assert_true(program_agrees(renderer, scene, &picture, expected));
    free(expected);
    clrt_scene_free(scene);
}

TEST(a_loaded_scene_or_mesh_is_the_programs_picture)
{
    static const char *const names[] = {"scenes/reflections.scn", "scenes/simple.scn",
                                        "scenes/blinn_phong.scn", "tests/image/every_feature.scn",
                                        "scenes/tetrahedron.ply"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        expect_program(load(program_file(names[i])), names[i], "",
                       (ClrtPicture){.width = 150, .height = 131});
}

TEST(views_samples_and_levels_are_the_programs)
{
    const char *name = "scenes/reflections.scn";
    expect_program(
        load(program_file(name)), name, "--view 3 --aa=3 --max-level 1",
        (ClrtPicture){.width = 60, .height = 40, .view = 3, .samples = 3, .max_level = 1});
}

TEST(a_filled_scene_is_the_programs_picture_of_the_same_file)
{
    for (uint32_t view = 1; view <= 2; view++)
        expect_program(filled_make(), "tests/library/filled.scn",
                       view == 1 ? "--view 1" : "--view 2",
                       (ClrtPicture){.width = 150, .height = 100, .view = view, .max_level = 5});
}

TEST(the_info_counts_the_added_objects)
{
    ClrtScene *scene = filled_make();
    ClrtSceneInfo info = {.size = sizeof info};
    assert_true(clrt_scene_get_info(scene, &info, NULL));
    assert_int_equal(info.width, 512);
    assert_int_equal(info.height, 512);
    assert_int_equal(info.max_level, 3);
    assert_int_equal(info.view_count, 2);
    assert_int_equal(info.light_count, 3);
    assert_int_equal(info.material_count, 6);
    assert_int_equal(info.sphere_count, 2);
    assert_int_equal(info.triangle_count, 5);
    assert_int_equal(info.dropped_triangle_count, 1);
    clrt_scene_free(scene);
}

TEST(a_camera_of_the_pictures_own_takes_the_views_place)
{
    ClrtScene *scene = filled_make();
    ClrtPicture picture = {.size = sizeof picture, .width = 90, .height = 70, .view = 2};
    float *by_view = draw(scene, &picture);
    picture.view = 1;
    picture.camera = &filled_cameras[1];
    assert_true(program_agrees(renderer, scene, &picture, by_view));
    free(by_view);
    clrt_scene_free(scene);
}

TEST(a_scene_that_was_changed_is_drawn_changed)
{
    const ClrtPicture picture = {.size = sizeof picture, .width = 40, .height = 30};
    const double black[3] = {0, 0, 0}, center[3] = {0, 0, 3};
    const size_t bytes = 3 * 40 * 30 * sizeof(float);
    ClrtScene *scene = filled_make();
    float *pictures[3];
    pictures[0] = draw(scene, &picture);
    assert_true(clrt_scene_set_background(scene, black, NULL));
    pictures[1] = draw(scene, &picture);
    assert_true(clrt_scene_add_sphere(scene, center, 0.5, CLRT_MATERIAL_MATTE, NULL));
    pictures[2] = draw(scene, &picture);
    assert_memory_not_equal(pictures[0], pictures[1], bytes);
    assert_memory_not_equal(pictures[1], pictures[2], bytes);
    for (int i = 0; i < 3; i++)
        free(pictures[i]);
    clrt_scene_free(scene);
}

static bool count_tiles(void *user, uint64_t tiles_done, uint64_t tiles)
{
    uint64_t *last = user;
    assert_int_equal(tiles, 6);
    assert_int_equal(tiles_done, ++*last);
    return true;
}

TEST(progress_counts_every_tile)
{
    uint64_t last = 0;
    const ClrtPicture picture = {.size = sizeof picture,
                                 .width = 300,
                                 .height = 200,
                                 .progress = count_tiles,
                                 .user = &last};
    ClrtScene *scene = filled_make();
    free(draw(scene, &picture));
    assert_int_equal(last, 6);
    clrt_scene_free(scene);
}

static bool stop_at_once(void *user, uint64_t tiles_done, uint64_t tiles)
{
    (void)user, (void)tiles_done, (void)tiles;
    return false;
}

// Returns whether rgb equals `whole` in a tile. If not, all floats of rgb in the tile must be -1.
static bool tile_is_whole(const float *rgb, const float *whole, const uint32_t tile[2],
                          const ClrtPicture *picture)
{
    size_t same = 0, untouched = 0, count = 0;
    for (uint32_t y = tile[1]; y < tile[1] + TILE && y < picture->height; y++)
        for (uint32_t x = tile[0]; x < tile[0] + TILE && x < picture->width; x++)
            for (uint32_t channel = 0; channel < 3; channel++, count++) {
                const size_t place = 3 * ((size_t)y * picture->width + x) + channel;
                same += memcmp(&rgb[place], &whole[place], sizeof *rgb) == 0;
                untouched += rgb[place] == -1;
            }
    assert_true(same == count || untouched == count);
    return same == count;
}

TEST(a_stopped_picture_has_whole_tiles_and_leaves_the_rest)
{
    ClrtError error;
    // A GPU draws up to half of the tiles before it can be stopped.
    ClrtPicture picture = {.size = sizeof picture, .width = 1600, .height = 1000};
    ClrtScene *scene = filled_make();
    float *whole = draw(scene, &picture);
    float *rgb = make_buffer(&picture);
    for (size_t i = 0; i < (size_t)3 * picture.width * picture.height; i++)
        rgb[i] = -1;
    picture.progress = stop_at_once;
    assert_false(clrt_render(renderer, scene, &picture, rgb, &error));
    assert_int_equal(error.fault, CLRT_STOPPED);
    int drawn = 0;
    for (uint32_t y = 0; y < picture.height; y += TILE)
        for (uint32_t x = 0; x < picture.width; x += TILE)
            drawn += tile_is_whole(rgb, whole, (const uint32_t[]){x, y}, &picture);
    assert_in_range(drawn, 1, 13 * 8 - 1);
    picture.progress = NULL;
    assert_true(program_agrees(renderer, scene, &picture, whole));
    free(rgb);
    free(whole);
    clrt_scene_free(scene);
}
