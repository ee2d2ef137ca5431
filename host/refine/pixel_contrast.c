// SPDX-License-Identifier: MIT
// Rows are copied in strips, channel by channel, so that compilers vectorize the comparisons. A
// strip also holds the pixels beside it. At the picture's edge, a pixel is its own neighbor.
#include "refine/adaptive.h"

#include "refine/pixel_contrast.h"

#include <stdlib.h>

#define STRIP        64 // pixels, of whole blocks
#define STRIP_SPAN   (STRIP + 2 * PACKET_SIDE)
#define ROWS_OF_TASK 16

// One row of a strip. The strip's pixels start at index PACKET_SIDE, between the pixels of the
// neighboring blocks.
typedef struct {
    float channels[3][STRIP_SPAN];
    uint32_t signatures[STRIP_SPAN];
} StripRow;

typedef struct {
    const RefineTree *tree;
    PixelContrasts *contrasts;
} Comparing;

static float larger(float a, float b)
{
    return a > b ? a : b;
}

static void take_pixel(StripRow *row, uint32_t at, const SampleData *sample)
{
    for (int channel = 0; channel < 3; channel++)
        row->channels[channel][at] = sample->color[channel];
    row->signatures[at] = sample->signature;
}

static void copy_pixel(StripRow *row, uint32_t to, uint32_t from)
{
    for (int channel = 0; channel < 3; channel++)
        row->channels[channel][to] = row->channels[channel][from];
    row->signatures[to] = row->signatures[from];
}

// Copies count pixels of a row from left on, and the pixels around them.
static void load_row(const RefineTree *tree, uint32_t left, uint32_t y, uint32_t count,
                     StripRow *row)
{
    const uint32_t first = left == 0 ? 0 : left - PACKET_SIDE;
    const uint32_t blocks = tree->columns * PACKET_SIDE;
    const uint32_t end = left + STRIP + PACKET_SIDE < blocks ? left + STRIP + PACKET_SIDE : blocks;
    for (uint32_t x = first; x < end; x += PACKET_SIDE) {
        const SampleData *run = &tree->pixels[refine_tree_place(tree, x, y)];
        for (uint32_t i = 0; i < PACKET_SIDE; i++)
            take_pixel(row, PACKET_SIDE + x - left + i, &run[i]);
    }
    if (left == 0)
        copy_pixel(row, PACKET_SIDE - 1, PACKET_SIDE);
    if (left + count == tree->width)
        copy_pixel(row, PACKET_SIDE + count, PACKET_SIDE + count - 1);
}

// Raises each step to the color difference from the pixel of another row, shift places to the
// right. Pixels on the same surface have no step.
static void add_steps(const StripRow *row, const StripRow *other, int shift, float steps[STRIP])
{
    for (int i = 0; i < STRIP; i++) {
        const int at = i + PACKET_SIDE, to = at + shift;
        const float red = fabsf(row->channels[0][at] - other->channels[0][to]);
        const float green = fabsf(row->channels[1][at] - other->channels[1][to]);
        const float blue = fabsf(row->channels[2][at] - other->channels[2][to]);
        const float most = larger(larger(red, green), blue);
        const float step = row->signatures[at] != other->signatures[to] ? most : 0;
        steps[i] = larger(steps[i], step);
    }
}

// Raises each bend to twice the pixel's distance from the mean of two neighbors. They are shift
// places to the left in rows[0] and shift places to the right in rows[2].
static void add_bends(const StripRow *const rows[3], int shift, float bends[STRIP])
{
    for (int channel = 0; channel < 3; channel++)
        for (int i = 0; i < STRIP; i++) {
            const int at = i + PACKET_SIDE;
            const float line = 0.5f * rows[0]->channels[channel][at - shift] +
                               0.5f * rows[2]->channels[channel][at + shift];
            bends[i] = larger(bends[i], 2 * fabsf(rows[1]->channels[channel][at] - line));
        }
}

// Computes the contrasts of one row. A pixel at the picture's edge has no bend across the edge,
// because a neighbor is missing.
static void compare_row(const Comparing *comparing, const StripRow *const rows[3], uint32_t left,
                        uint32_t y, uint32_t count)
{
    const RefineTree *tree = comparing->tree;
    const StripRow *const beside[3] = {rows[1], rows[1], rows[1]};
    float steps[STRIP] = {0}, bends[STRIP] = {0};
    add_bends(beside, 1, bends);
    if (left == 0)
        bends[0] = 0;
    if (left + count == tree->width)
        bends[count - 1] = 0;
    if (y > 0 && y + 1 < tree->height)
        add_bends(rows, 0, bends);
    add_steps(rows[1], rows[1], -1, steps);
    add_steps(rows[1], rows[1], 1, steps);
    add_steps(rows[1], rows[0], 0, steps);
    add_steps(rows[1], rows[2], 0, steps);
    float *values = &comparing->contrasts->values[(size_t)y * tree->width + left];
    for (uint32_t i = 0; i < count; i++) {
        const float value = larger(CONTRAST_OUTLINE_WEIGHT * steps[i], bends[i]);
        values[i] = contrast_kept((CellContrast){value, steps[i] > 0});
    }
}

// places[y % 3] holds row y, so three buffers hold the current row and both adjacent rows.
static void compare_strip(const Comparing *comparing, uint32_t left, uint32_t top, uint32_t bottom)
{
    const RefineTree *tree = comparing->tree;
    const uint32_t count = tree->width - left < STRIP ? tree->width - left : STRIP;
    const uint32_t last = tree->height - 1;
    StripRow places[3] = {0};
    load_row(tree, left, top == 0 ? 0 : top - 1, count, &places[(top + 2) % 3]);
    load_row(tree, left, top, count, &places[top % 3]);
    for (uint32_t y = top; y < bottom; y++) {
        const StripRow *const rows[3] = {&places[(y + 2) % 3], &places[y % 3],
                                         &places[(y + 1) % 3]};
        load_row(tree, left, y < last ? y + 1 : last, count, &places[(y + 1) % 3]);
        compare_row(comparing, rows, left, y, count);
    }
}

static void compare_rows(void *context, uint32_t first, uint32_t end)
{
    const Comparing *comparing = context;
    const RefineTree *tree = comparing->tree;
    for (uint32_t left = 0; left < tree->width; left += STRIP)
        compare_strip(comparing, left, first, end);
}

bool pixel_contrasts_make(PixelContrasts *contrasts, const RefineTree *tree, ThreadPool *pool,
                          Error *error)
{
    Comparing comparing = {tree, contrasts};
    *contrasts = (PixelContrasts){.width = tree->width};
    contrasts->values =
        memory_raw((size_t)tree->width * tree->height, sizeof *contrasts->values, error);
    if (contrasts->values == NULL)
        return false;
    thread_pool_share(pool, tree->height, ROWS_OF_TASK, compare_rows, &comparing);
    return true;
}

void pixel_contrasts_free(PixelContrasts *contrasts)
{
    free(contrasts->values);
    *contrasts = (PixelContrasts){0};
}

// Examines patches of 32 x PACKET_SIDE pixels, because most patches need no refinement and are
// skipped as a whole. Threads list the pixels to refine, and one thread applies the lists in order.

#define PATCH_WIDTH 32
#define MARKED_ROWS (4 * PACKET_SIDE)

typedef struct {
    uint32_t x, y;
    bool is_cut; // otherwise, its seams are opened
} PixelMark;

// The result of a range.
typedef struct {
    ARRAY(PixelMark) marks;
    Error error;
} MarkList;

typedef struct {
    const RefineTree *tree;
    const PixelWants *wants;
    MarkList *lists; // of each range
} Marking;

static uint32_t smaller(uint32_t a, uint32_t b)
{
    return a < b ? a : b;
}

static bool any_exceeds(const float *contrasts, uint32_t count, float threshold)
{
    int exceeds = 0;
    for (uint32_t i = 0; i < count; i++)
        exceeds |= fabsf(contrasts[i]) > threshold;
    return exceeds != 0;
}

// Returns a bit for each pixel of a patch's row that has high contrast or a thin part.
static uint32_t asking_pixels(const Marking *marking, uint32_t left, uint32_t y)
{
    const RefineTree *tree = marking->tree;
    const PixelWants *wants = marking->wants;
    const uint32_t count = smaller(PATCH_WIDTH, tree->width - left);
    const float *contrasts = &wants->contrasts->values[(size_t)y * tree->width + left];
    uint32_t asking = thin_parts_pixels(wants->thin_parts, left, y);
    if (any_exceeds(contrasts, count, wants->threshold))
        for (uint32_t i = 0; i < count; i++)
            asking |= (uint32_t)(fabsf(contrasts[i]) > wants->threshold) << i;
    return asking;
}

static bool mark_pixel(const Marking *marking, uint32_t x, uint32_t y, MarkList *list)
{
    const RefineTree *tree = marking->tree;
    const PixelWants *wants = marking->wants;
    const size_t pixel = (size_t)y * tree->width + x;
    const uint32_t place[2] = {x * REFINE_GRID, y * REFINE_GRID};
    const CellContrast contrast = pixel_contrast(wants->contrasts, x, y);
    if (tree->pixel_groups[pixel] != 0)
        return true;
    const PixelMark mark = {x, y,
                            !contrast.is_step || thin_parts_cut(wants->thin_parts, place, 0) ||
                                contrast_past_seams(contrast.value) > wants->threshold};
    return (!mark.is_cut && tree->pixel_seams[pixel] != 0) ||
           array_push(&list->marks, mark, &list->error);
}

static bool mark_patch(const Marking *marking, uint32_t left, uint32_t top, MarkList *list)
{
    const uint32_t rows = smaller(PACKET_SIDE, marking->tree->height - top);
    uint32_t asking[PACKET_SIDE] = {0}, any = 0;
    for (uint32_t row = 0; row < rows; row++) {
        asking[row] = asking_pixels(marking, left, top + row);
        any |= asking[row];
    }
    for (uint32_t block = 0; block < PATCH_WIDTH && any >> block != 0; block += PACKET_SIDE)
        for (uint32_t i = 0; i < PACKET_SIDE * PACKET_SIDE; i++) {
            const uint32_t column = block + i % PACKET_SIDE, row = i / PACKET_SIDE;
            if ((asking[row] >> column & 1) != 0 &&
                !mark_pixel(marking, left + column, top + row, list))
                return false;
        }
    return true;
}

static void mark_rows(void *context, uint32_t first, uint32_t end)
{
    const Marking *marking = context;
    const RefineTree *tree = marking->tree;
    for (uint32_t top = first; top < end; top += PACKET_SIDE)
        for (uint32_t left = 0; left < tree->width; left += PATCH_WIDTH)
            if (!mark_patch(marking, left, top, &marking->lists[first / MARKED_ROWS]))
                return;
}

static bool take_list(RefineTree *tree, const MarkList *list, Error *error)
{
    if (list->error.text[0] != '\0')
        return error_set(error, "%s", list->error.text);
    for (size_t i = 0; i < list->marks.count; i++) {
        const PixelMark *mark = &list->marks.data[i];
        if (!(mark->is_cut ? refine_tree_cut_pixel(tree, mark->x, mark->y, error)
                           : refine_tree_open_pixel(tree, mark->x, mark->y, error)))
            return false;
    }
    return true;
}

bool pixel_marks_take(RefineTree *tree, const PixelWants *wants, ThreadPool *pool, Error *error)
{
    const uint32_t tasks = range_count(tree->height, MARKED_ROWS);
    Marking marking = {tree, wants, memory_zeroed(tasks, sizeof *marking.lists, error)};
    bool ok = marking.lists != NULL;
    if (ok)
        thread_pool_share(pool, tree->height, MARKED_ROWS, mark_rows, &marking);
    for (uint32_t task = 0; marking.lists != NULL && task < tasks; task++) {
        ok = ok && take_list(tree, &marking.lists[task], error);
        free(marking.lists[task].marks.data);
    }
    free(marking.lists);
    return ok;
}
