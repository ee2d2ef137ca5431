// SPDX-License-Identifier: MIT
// The device's denormals, the division and order of the work, and the kernels' specialization do
// not change a bit of the picture. test_hashes_unoptimized does without optimization.
#include "support/random.h"
#include "support/varied_scene.h"

#include <string.h>

#define SIZE 96

static PictureSettings usual_settings(void)
{
    PictureSettings settings = picture_settings(SIZE);
    settings.render.samples = 2;
    return settings;
}

// Returns how many pixels of the varied scene the settings change.
static Outcome compare_with(const char *test, const Studio *studio, const PictureSettings *settings)
{
    const PictureSettings usually = usual_settings();
    Framebuffer usual = varied_picture(studio, &usually);
    assert_int_equal(picture_count_faults(&usual), 0);
    const Outcome outcome = picture_compare(test, &usual, varied_picture(studio, settings));
    framebuffer_free(&usual);
    return outcome;
}

static void flushing_denormals_to_zero_changes_no_picture_t47(void **state)
{
    PictureSettings settings = usual_settings();
    settings.extra_options = "-cl-denorms-are-zero";
    outcome_report(compare_with("T-47", *state, &settings), "option=%s", settings.extra_options);
}

static void specialized_kernels_draw_the_same_picture_t48(void **state)
{
    PictureSettings settings = usual_settings();
    settings.render.specialization = SPECIALIZE_ALWAYS;
    outcome_report(compare_with("T-48", *state, &settings), "program=specialized");
}

static void the_same_picture_is_drawn_twice_t48(void **state)
{
    const PictureSettings settings = usual_settings();
    outcome_report(compare_with("T-48", *state, &settings), "run=second");
}

// The varied picture's hash on every device and target, which CMakeLists.txt chooses.
#define PICTURE_ON_RECORD "ec5c80aa50c8f17918c2bed9c22cfbeb"

static void the_picture_is_the_one_on_record_t48(void **state)
{
    char hash[FRAMEBUFFER_HASH_SIZE];
    const char *target = getenv("CLRT_TEST_TARGET");
    const PictureSettings settings = usual_settings();
    Framebuffer picture = varied_picture(*state, &settings);
    framebuffer_hash(&picture, hash);
    framebuffer_free(&picture);
    outcome_report(outcome_of("T-48", SIZE * SIZE, strcmp(hash, PICTURE_ON_RECORD) != 0),
                   "target=%s hash=%s", target != NULL ? target : "usual", hash);
}

static void judge_group(const Studio *studio, uint32_t width, uint32_t height)
{
    PictureSettings settings = usual_settings();
    settings.render.group_width = width;
    settings.render.group_height = height;
    outcome_report(compare_with("T-48", studio, &settings), "group=%ux%u", width, height);
}

static void work_groups_of_any_shape_draw_the_same_picture_t48(void **state)
{
    static const uint32_t groups[][2] = {{1, 1},  {2, 1},   {1, 3},    {5, 7},  {8, 8},
                                         {16, 4}, {1, 256}, {1024, 1}, {32, 32}};
    for (size_t i = 0; i < COUNT(groups); i++)
        judge_group(*state, groups[i][0], groups[i][1]);
    for (uint32_t items = 4; items <= 512 && tier() > 0; items *= 2)
        judge_group(*state, items, 1);
}

static void tiles_of_any_size_draw_the_same_picture_t48(void **state)
{
    static const uint32_t tiles[][2] = {{1, SIZE}, {7, 5}, {17, 64}, {SIZE, SIZE}, {1000, 1}};
    PictureSettings settings = usual_settings();
    for (size_t i = 0; i < COUNT(tiles); i++) {
        settings.render.tile_width = tiles[i][0];
        settings.render.tile_height = tiles[i][1];
        outcome_report(compare_with("T-48", *state, &settings), "tile=%ux%u", tiles[i][0],
                       tiles[i][1]);
    }
}

#define TILES (SIZE / 32 * SIZE / 32)

// Draws the tiles one by one, each as a part of its own, in a random order.
static Framebuffer draw_shuffled(const Studio *studio, Random *random)
{
    Stage stage;
    Renderer renderer;
    Error error = {0};
    Framebuffer picture;
    uint32_t order[TILES] = {0};
    const PictureSettings settings = usual_settings();
    Scene scene = varied_scene();
    const CameraData camera = picture_camera(&scene, &settings.render);
    picture_open(&renderer, &stage, studio, &scene, &settings);
    require(framebuffer_make(&picture, SIZE, SIZE, &error), &error);
    renderer.settings.parts = TILES;
    for (uint32_t i = 0; i < TILES; i++) {
        const uint32_t other = random_below(random, i + 1);
        order[i] = order[other];
        order[other] = i;
    }
    for (uint32_t i = 0; i < TILES; i++) {
        renderer.settings.part = order[i];
        require(renderer_draw(&renderer, &camera, NULL, &picture, &error), &error);
    }
    renderer_close(&renderer);
    stage_free(&stage);
    scene_free(&scene);
    return picture;
}

static void tiles_in_any_order_draw_the_same_picture_t48(void **state)
{
    Random random = {48};
    const PictureSettings settings = usual_settings();
    Framebuffer usual = varied_picture(*state, &settings);
    for (int i = 0; i < 4; i++)
        outcome_report(picture_compare("T-48", &usual, draw_shuffled(*state, &random)), "order=%d",
                       i);
    framebuffer_free(&usual);
}

RUN_TESTS(picture_setup, picture_teardown,
          EXTREME(flushing_denormals_to_zero_changes_no_picture_t47),
          EXTREME(the_same_picture_is_drawn_twice_t48),
          EXTREME(the_picture_is_the_one_on_record_t48),
          EXTREME(specialized_kernels_draw_the_same_picture_t48),
          EXTREME(work_groups_of_any_shape_draw_the_same_picture_t48),
          EXTREME(tiles_of_any_size_draw_the_same_picture_t48),
          EXTREME(tiles_in_any_order_draw_the_same_picture_t48))
