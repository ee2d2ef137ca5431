// SPDX-License-Identifier: MIT
// One scene gives one picture, regardless of the device's denormals, the division and order of the
// work, and the optimization of the kernels.
#include "support/check.h"
#include "support/picture.h"
#include "support/random.h"
#include "support/report.h"
#include "support/tier.h"
#include "support/varied_scene.h"

#include <stdlib.h>
#include <string.h>

#define SIZE 96

static PictureSettings usual_settings(void)
{
    PictureSettings settings = picture_settings();
    settings.render.width = settings.render.height = SIZE;
    settings.render.samples = 2;
    return settings;
}

static void draw_varied(Framebuffer *picture, const Studio *studio, const PictureSettings *settings)
{
    Scene scene = varied_scene();
    picture_draw(picture, studio, &scene, settings);
    scene_free(&scene);
}

// How many pixels the settings change.
static size_t differences_with(const Studio *studio, const PictureSettings *settings)
{
    Framebuffer usual, other;
    const PictureSettings usually = usual_settings();
    draw_varied(&usual, studio, &usually);
    draw_varied(&other, studio, settings);
    assert_int_equal(picture_count_faults(&usual), 0);
    assert_in_range(picture_count_covered(&usual), SIZE * SIZE / 3, SIZE * SIZE);
    const size_t differences = picture_count_differences(&usual, &other);
    framebuffer_free(&usual);
    framebuffer_free(&other);
    return differences;
}

static void expect_no_difference(const Studio *studio, const char *test, const char *details,
                                 const PictureSettings *settings)
{
    assert_int_equal(report_case(test, details, SIZE * SIZE, differences_with(studio, settings)),
                     0);
}

static void flushing_denormals_to_zero_changes_no_picture_t47(void **state)
{
    PictureSettings settings = usual_settings();
    settings.extra_options = "-cl-denorms-are-zero";
    expect_no_difference(*state, "T-47", "option=-cl-denorms-are-zero", &settings);
}

static void unoptimized_kernels_draw_the_same_picture_t48(void **state)
{
    PictureSettings settings = usual_settings();
    settings.extra_options = "-cl-opt-disable";
    expect_no_difference(*state, "T-48", "option=-cl-opt-disable", &settings);
}

static void specialized_kernels_draw_the_same_picture_t48(void **state)
{
    PictureSettings settings = usual_settings();
    settings.render.specialization = SPECIALIZE_ALWAYS;
    expect_no_difference(*state, "T-48", "program=specialized", &settings);
}

static void the_same_picture_is_drawn_twice_t48(void **state)
{
    const PictureSettings settings = usual_settings();
    expect_no_difference(*state, "T-48", "run=second", &settings);
}

// The varied picture's hash, on whatever device and target draws it: CMakeLists.txt chooses these.
#define PICTURE_ON_RECORD "ec5c80aa50c8f17918c2bed9c22cfbeb"

static void the_picture_is_the_one_on_record_t48(void **state)
{
    Framebuffer picture;
    char details[64], hash[FRAMEBUFFER_HASH_SIZE];
    const char *target = getenv("CLRT_TEST_TARGET");
    const PictureSettings settings = usual_settings();
    draw_varied(&picture, *state, &settings);
    framebuffer_hash(&picture, hash);
    framebuffer_free(&picture);
    snprintf(details, sizeof details, "target=%s", target != NULL ? target : "usual");
    report_case("T-48", details, SIZE * SIZE, strcmp(hash, PICTURE_ON_RECORD) != 0);
    assert_string_equal(hash, PICTURE_ON_RECORD);
}

static void work_groups_of_1_to_1024_items_draw_the_same_picture_t48(void **state)
{
    size_t differences = 0;
    for (uint32_t items = 1; items <= 1024 && tier() > 0; items *= 2) {
        char details[32];
        PictureSettings settings = usual_settings();
        settings.render.group_width = items;
        settings.render.group_height = 1;
        snprintf(details, sizeof details, "group=%ux1", items);
        differences +=
            report_case("T-48", details, SIZE * SIZE, differences_with(*state, &settings));
    }
    assert_int_equal(differences, 0);
}

static void work_groups_of_any_shape_draw_the_same_picture_t48(void **state)
{
    static const uint32_t groups[][2] = {{1, 1},  {2, 1},   {1, 3},    {5, 7},  {8, 8},
                                         {16, 4}, {1, 256}, {1024, 1}, {32, 32}};
    size_t differences = 0;
    for (size_t i = 0; i < sizeof groups / sizeof *groups; i++) {
        char details[32];
        PictureSettings settings = usual_settings();
        settings.render.group_width = groups[i][0];
        settings.render.group_height = groups[i][1];
        snprintf(details, sizeof details, "group=%ux%u", groups[i][0], groups[i][1]);
        differences +=
            report_case("T-48", details, SIZE * SIZE, differences_with(*state, &settings));
    }
    assert_int_equal(differences, 0);
}

static void tiles_of_any_size_draw_the_same_picture_t48(void **state)
{
    static const uint32_t tiles[][2] = {{1, SIZE}, {7, 5}, {17, 64}, {SIZE, SIZE}, {1000, 1}};
    size_t differences = 0;
    for (size_t i = 0; i < sizeof tiles / sizeof *tiles; i++) {
        char details[32];
        PictureSettings settings = usual_settings();
        settings.render.tile_width = tiles[i][0];
        settings.render.tile_height = tiles[i][1];
        snprintf(details, sizeof details, "tile=%ux%u", tiles[i][0], tiles[i][1]);
        differences +=
            report_case("T-48", details, SIZE * SIZE, differences_with(*state, &settings));
    }
    assert_int_equal(differences, 0);
}

#define TILE    32
#define COLUMNS (SIZE / TILE)
#define TILES   (COLUMNS * COLUMNS)

static void require_success(cl_int status, const char *attempt)
{
    Error error = {0};
    require(cl_succeeded(status, attempt, &error), &error);
}

// Draws one tile alone, as draw.c does.
static void draw_tile(const Renderer *renderer, cl_mem pixels, uint32_t tile, FrameData frame,
                      Framebuffer *picture)
{
    float colors[TILE * TILE][3];
    frame.tile_x = tile % COLUMNS * TILE;
    frame.tile_y = tile / COLUMNS * TILE;
    frame.tile_width = frame.tile_height = TILE;
    cl_int status = clSetKernelArg(renderer->kernel, 0, sizeof frame, &frame);
    for (cl_uint place = 0; place < RENDERER_ARRAYS; place++)
        status |=
            clSetKernelArg(renderer->kernel, place + 1, sizeof(cl_mem), &renderer->arrays[place]);
    status |= clSetKernelArg(renderer->kernel, RENDERER_ARRAYS + 1, sizeof(cl_mem), &pixels);
    status |= clSetKernelArg(renderer->kernel, RENDERER_ARRAYS + 2, sizeof(cl_mem), &pixels);
    require_success(status, "set the kernel's arguments");
    const uint32_t side = renderer->settings.group_width;
    const size_t items = renderer->nodes == NODES_WIDE ? TILE / PACKET_SIDE : TILE;
    const size_t grid[2] = {items, items}, group[2] = {side, side};
    cl_command_queue queue = renderer->device->queue;
    require_success(
        clEnqueueNDRangeKernel(queue, renderer->kernel, 2, NULL, grid, group, 0, NULL, NULL),
        "run the kernel");
    require_success(
        clEnqueueReadBuffer(queue, pixels, CL_TRUE, 0, sizeof colors, colors, 0, NULL, NULL),
        "read a tile");
    for (size_t row = 0; row < TILE; row++)
        memcpy(picture->pixels[(frame.tile_y + row) * SIZE + frame.tile_x], colors[row * TILE],
               TILE * sizeof *colors);
}

static void draw_in_order(Framebuffer *picture, const Studio *studio, const uint32_t order[TILES])
{
    Stage stage;
    Renderer renderer;
    Error error = {0};
    cl_int status;
    const PictureSettings settings = usual_settings();
    Scene scene = varied_scene();
    picture_open(&renderer, &stage, studio, &scene, &settings);
    FrameData frame = renderer.frame;
    frame.camera = picture_camera(&scene, &settings.render);
    const cl_mem pixels = clCreateBuffer(studio->device.context, CL_MEM_WRITE_ONLY,
                                         sizeof(float[TILE * TILE][3]), NULL, &status);
    require_success(status, "make a buffer");
    require(framebuffer_make(picture, SIZE, SIZE, &error), &error);
    for (int i = 0; i < TILES; i++)
        draw_tile(&renderer, pixels, order[i], frame, picture);
    clReleaseMemObject(pixels);
    renderer_close(&renderer);
    stage_free(&stage);
    scene_free(&scene);
}

static void shuffle(uint32_t order[TILES], Random *random)
{
    for (uint32_t i = 0; i < TILES; i++)
        order[i] = i;
    for (uint32_t i = TILES - 1; i > 0; i--) {
        const uint32_t other = random_below(random, i + 1);
        const uint32_t swapped = order[i];
        order[i] = order[other];
        order[other] = swapped;
    }
}

static void tiles_in_any_order_draw_the_same_picture_t48(void **state)
{
    Framebuffer usual;
    Random random = {48};
    size_t differences = 0;
    const PictureSettings settings = usual_settings();
    draw_varied(&usual, *state, &settings);
    for (int i = 0; i < 4; i++) {
        char details[32];
        Framebuffer other;
        uint32_t order[TILES];
        shuffle(order, &random);
        draw_in_order(&other, *state, order);
        snprintf(details, sizeof details, "order=%d", i);
        differences +=
            report_case("T-48", details, SIZE * SIZE, picture_count_differences(&usual, &other));
        framebuffer_free(&other);
    }
    framebuffer_free(&usual);
    assert_int_equal(differences, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(flushing_denormals_to_zero_changes_no_picture_t47),
        cmocka_unit_test(the_same_picture_is_drawn_twice_t48),
        cmocka_unit_test(the_picture_is_the_one_on_record_t48),
        cmocka_unit_test(work_groups_of_1_to_1024_items_draw_the_same_picture_t48),
        cmocka_unit_test(unoptimized_kernels_draw_the_same_picture_t48),
        cmocka_unit_test(specialized_kernels_draw_the_same_picture_t48),
        cmocka_unit_test(work_groups_of_any_shape_draw_the_same_picture_t48),
        cmocka_unit_test(tiles_of_any_size_draw_the_same_picture_t48),
        cmocka_unit_test(tiles_in_any_order_draw_the_same_picture_t48),
    };
    return cmocka_run_group_tests(tests, picture_setup, picture_teardown);
}
