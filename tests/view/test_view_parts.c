// SPDX-License-Identifier: MIT
// Tests the parts of the viewer that need neither window nor device: the plan of passes, boxes,
// changed files, and pictures in two layers.
#include "unit/cmocka_all.h"
#include "unit/triangle_sets.h"
#include "view/draw/canvas.h"
#include "view/draw/ray_view.h"
#include "view/draw/scene_view.h"
#include "view/draw/target.h"
#include "view/draw/text_view.h"
#include "view/plan.h"
#include "view/watch.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

static const PlanRequest plain = {.is_wanted = true,
                                  .subject = 7,
                                  .full = {.width = 500, .height = 300, .samples = 2},
                                  .sample_seconds = 1e-9};

TEST(a_still_picture_sharpens_step_by_step)
{
    PlanRequest request = plain;
    request.sample_seconds = 1e-6;
    PlanReached reached = {0};
    Pass pass = plan_pass(&request, &reached);
    assert_int_equal(pass.kind, PASS_MOVING);
    assert_true(pass.divisor > 1 && pass.settings.samples == 1);
    assert_int_equal(pass.settings.width, (500 + pass.divisor - 1) / pass.divisor);
    reached = (PlanReached){7, pass.divisor, 1, false};
    pass = plan_pass(&request, &reached);
    assert_true(pass.kind == PASS_FULL && pass.divisor == 1 && pass.settings.samples == 1);
    reached = (PlanReached){7, 1, 1, false};
    pass = plan_pass(&request, &reached);
    assert_true(pass.kind == PASS_FULL && pass.settings.samples == 2);
    reached = (PlanReached){7, 1, 2, false};
    assert_int_equal(plan_pass(&request, &reached).kind, PASS_COUNT);
    reached.is_counted = true;
    assert_int_equal(plan_pass(&request, &reached).kind, PASS_NONE);
}

TEST(moving_pictures_take_the_time_of_a_frame)
{
    const PlanReached reached = {6, 1, 2, true}; // for another camera
    PlanRequest request = plain;
    assert_int_equal(plan_pass(&request, &reached).divisor, 1);
    for (double cost = 1e-9; cost < 1e-5; cost *= 1.1) {
        request.sample_seconds = cost;
        const Pass pass = plan_pass(&request, &reached);
        assert_int_equal(pass.kind, PASS_MOVING);
        assert_true(pass.settings.width * pass.settings.height * cost < PLAN_FRAME_SECONDS ||
                    pass.divisor == 16);
    }
}

TEST(tiles_are_so_small_that_stopping_takes_no_time)
{
    const PlanReached reached = {7, 1, 1, false};
    PlanRequest request = plain;
    assert_int_equal(plan_pass(&request, &reached).settings.tile_width, 128);
    for (double cost = 1e-9; cost < 4e-5; cost *= 1.1) {
        request.sample_seconds = cost;
        const Pass pass = plan_pass(&request, &reached);
        const double seconds = pass.settings.tile_width * pass.settings.tile_width * cost *
                               pass.settings.samples * pass.settings.samples;
        assert_true(seconds < 0.02 || pass.settings.tile_width == 8);
    }
}

TEST(nothing_is_traced_without_a_request_or_without_a_window)
{
    const PlanReached reached = {0};
    PlanRequest request = plain;
    request.full.width = 0;
    assert_int_equal(plan_pass(&request, &reached).kind, PASS_NONE);
    request = plain;
    request.is_wanted = false;
    assert_int_equal(plan_pass(&request, &reached).kind, PASS_NONE);
}

TEST(brute_force_is_expected_to_be_slow)
{
    assert_true(plan_first_guess(1000000, true) == plan_first_guess(10, true));
    assert_true(plan_first_guess(1000000, false) > 1e-4);
}

// Returns the number of boxes at a depth by recursion.
static uint32_t count_at(const Bvh *bvh, uint32_t number, uint32_t depth, uint32_t wanted)
{
    const BvhNode *node = &bvh->nodes[number];
    if (node->count > 0)
        return wanted == 0;
    return (depth == wanted) + count_at(bvh, node->first, depth + 1, wanted) +
           count_at(bvh, node->first + 1, depth + 1, wanted);
}

TEST(every_level_has_a_box_for_each_of_its_nodes)
{
    Bvh bvh;
    Error error = {0};
    uint32_t inner = 0;
    FREED_BY(triangles_free) Triangles triangles = triangle_set((TriangleSet)0, 500);
    const BvhSettings settings = {BVH_SAH, LEAVES_SINGLE};
    assert_true(bvh_build(&bvh, &triangles, &settings, NULL, &error));
    for (uint32_t depth = 0; depth <= boxes_deepest(&bvh); depth++) {
        FREED_BY(boxes_free) Boxes boxes = {0};
        assert_true(boxes_make(&boxes, &bvh, depth, &error));
        assert_int_equal(boxes.count, count_at(&bvh, 0, 1, depth));
        assert_true(boxes.count > 0);
        inner += depth > 0 ? (uint32_t)boxes.count : 0;
        if (depth == 1)
            assert_memory_equal(&boxes.data[0], &bvh.nodes[0].box, sizeof(Box));
    }
    assert_int_equal(inner, bvh.node_count - bvh.leaf_count);
    bvh_free(&bvh);
}

TEST(a_tree_of_nothing_or_one_leaf_has_no_inner_boxes)
{
    FREED_BY(boxes_free) Boxes boxes = {0};
    Error error = {0};
    Bvh none = {0};
    assert_int_equal(boxes_deepest(&none), 0);
    assert_true(boxes_make(&boxes, &none, 0, &error));
    assert_int_equal(boxes.count, 0);
    BvhNode leaf = {.count = 3};
    const Bvh single = {.nodes = &leaf, .node_count = 1, .leaf_count = 1, .depth = 1};
    assert_int_equal(boxes_deepest(&single), 0);
    assert_true(boxes_make(&boxes, &single, 0, &error));
    assert_int_equal(boxes.count, 1);
}

static void write_text(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static void set_time(const char *path, long nanoseconds)
{
    const struct timespec times[2] = {{1000, nanoseconds}, {1000, nanoseconds}};
    assert_int_equal(utimensat(AT_FDCWD, path, times, 0), 0);
}

// A folder, the path of a file in it, and a watch, which is empty at first.
typedef struct {
    char folder[32], path[64];
    Watch watch;
} WatchedFolder;

static WatchedFolder watched_make(void)
{
    WatchedFolder watched = {.folder = "/tmp/clrt-watch-XXXXXX"};
    assert_non_null(mkdtemp(watched.folder));
    snprintf(watched.path, sizeof watched.path, "%s/file", watched.folder);
    return watched;
}

static void watched_free(WatchedFolder *watched)
{
    watch_free(&watched->watch);
    unlink(watched->path);
    rmdir(watched->folder);
}

TEST(changed_files_are_reported_once_after_the_last_change)
{
    Error error = {0};
    FREED_BY(watched_free) WatchedFolder watched = watched_make();
    write_text(watched.path, "one");
    const char *const paths[] = {watched.path, watched.folder};
    assert_true(watch_set(&watched.watch, paths, 2, &error));
    for (int look = 0; look < 3; look++)
        assert_false(watch_poll(&watched.watch));
    set_time(watched.path, 1);
    assert_false(watch_poll(&watched.watch)); // the file may still be incomplete
    assert_true(watch_poll(&watched.watch));
    assert_false(watch_poll(&watched.watch));
    unlink(watched.path);
    assert_false(watch_poll(&watched.watch));
    assert_true(watch_poll(&watched.watch));
    write_text(watched.path, "two");
    assert_false(watch_poll(&watched.watch));
    assert_true(watch_poll(&watched.watch));
}

TEST(watching_other_files_too_loses_no_change)
{
    Error error = {0};
    FREED_BY(watched_free) WatchedFolder watched = watched_make();
    write_text(watched.path, "one");
    assert_true(watch_set(&watched.watch, (const char *[]){watched.path, "gone"}, 2, &error));
    set_time(watched.path, 1);
    assert_true(watch_set(&watched.watch, (const char *[]){"other", watched.path}, 2, &error));
    assert_int_equal(watched.watch.files.count, 2);
    assert_false(watch_poll(&watched.watch));
    assert_true(watch_poll(&watched.watch));
}

TEST(a_new_file_in_a_watched_folder_is_a_change)
{
    Error error = {0};
    FREED_BY(watched_free) WatchedFolder watched = watched_make();
    const char *const paths[] = {watched.folder};
    assert_true(watch_set(&watched.watch, paths, 1, &error));
    assert_false(watch_poll(&watched.watch));
    write_text(watched.path, "new");
    assert_false(watch_poll(&watched.watch));
    assert_true(watch_poll(&watched.watch));
}

TEST(a_picture_in_progress_covers_the_whole_one_until_it_takes_its_place)
{
    Canvas canvas;
    Error error = {0};
    const RenderSettings settings = {.width = 4, .height = 2, .tile_width = 2, .tile_height = 2};
    canvas_open(&canvas, ENCODE_RAW);
    assert_null(canvas_whole(&canvas));
    Layer *first = canvas_begin(&canvas, &settings, true, &error);
    assert_null(canvas_unfinished(&canvas)); // this picture is hidden until it is complete
    first->framebuffer.pixels[3][1] = 0.5f;
    canvas_add_tiles(&canvas, first, 2, 1);
    canvas_end(&canvas, first, true);
    assert_ptr_equal(canvas_whole(&canvas), first);
    assert_int_equal(first->bytes[3 * 3 + 1], 128);
    const uint64_t pass = first->pass;
    canvas_encode_again(&canvas, 4);
    assert_int_equal(first->bytes[3 * 3 + 1], 255); // brighter colors become white
    assert_true(first->pass > pass);                // OpenGL copies it again
    Layer *second = canvas_begin(&canvas, &settings, false, &error);
    assert_ptr_equal(canvas_unfinished(&canvas), second);
    canvas_add_tiles(&canvas, second, 1, 1);
    assert_int_equal(second->tiles_done, 1);
    assert_ptr_equal(canvas_whole(&canvas), first);
    canvas_end(&canvas, second, false);
    assert_null(canvas_unfinished(&canvas));
    second = canvas_begin(&canvas, &settings, false, &error);
    canvas_end(&canvas, second, true);
    assert_ptr_equal(canvas_whole(&canvas), second);
    canvas_close(&canvas);
}
