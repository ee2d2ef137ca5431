// SPDX-License-Identifier: MIT
// Examines patches of 32 x PACKET_SIDE pixels, because most patches need no refinement and are
// skipped as a whole. Threads list the pixels to refine, and one thread applies the lists in order.
#include "refine/adaptive.h"

#include <stdlib.h>

#define PATCH_WIDTH  32
#define ROWS_OF_TASK (4 * PACKET_SIDE)

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
            if (!mark_patch(marking, left, top, &marking->lists[first / ROWS_OF_TASK]))
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
    const uint32_t tasks = range_count(tree->height, ROWS_OF_TASK);
    Marking marking = {tree, wants, memory_zeroed(tasks, sizeof *marking.lists, error)};
    bool ok = marking.lists != NULL;
    if (ok)
        thread_pool_share(pool, tree->height, ROWS_OF_TASK, mark_rows, &marking);
    for (uint32_t task = 0; marking.lists != NULL && task < tasks; task++) {
        ok = ok && take_list(tree, &marking.lists[task], error);
        free(marking.lists[task].marks.data);
    }
    free(marking.lists);
    return ok;
}
