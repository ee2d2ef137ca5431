// SPDX-License-Identifier: MIT
// Each pass marks cells in parallel, subdivides the marked cells in order, and traces their samples
// as one list. The next pass examines the new groups.
#include "refine/adaptive.h"

#include "refine/pixel_contrast.h"
#include "render/renderer.h"

#include <stdlib.h>

// A list contains eight samples per new group, in the order of the groups, then one per seam that
// needs a sample.

#define GROUPS_OF_TASK 512

// The places and samples of the groups from first on, eight per group.
typedef struct {
    RefineTree *tree;
    uint32_t first;
    SamplePlace *places;
    SampleData *samples;
} Exchange;

static void list_places(void *context, uint32_t first, uint32_t end)
{
    const Exchange *exchange = context;
    const RefineTree *tree = exchange->tree;
    SamplePlace *places = exchange->places + (size_t)first * ADAPTIVE_CUT;
    for (uint32_t i = first; i < end; i++)
        for (uint32_t cell = 0; cell < GROUP_CELLS; cell++) {
            uint32_t place[2];
            if (cell == GROUP_MIDDLE)
                continue;
            refine_tree_cell_place(&tree->groups.data[exchange->first + i], cell, place);
            *places++ = (SamplePlace){place[0], place[1]};
        }
}

static void take_samples(void *context, uint32_t first, uint32_t end)
{
    const Exchange *exchange = context;
    RefineTree *tree = exchange->tree;
    const SampleData *samples = exchange->samples + (size_t)first * ADAPTIVE_CUT;
    for (uint32_t i = first; i < end; i++) {
        CellGroup *group = &tree->groups.data[exchange->first + i];
        for (uint32_t cell = 0; cell < GROUP_CELLS; cell++)
            if (cell != GROUP_MIDDLE)
                group->cells[cell] = *samples++;
        contrast_keep(group);
    }
}

// Returns whether the last pass completed without a stop by the observer.
static bool adaptive_is_whole(const Adaptive *adaptive)
{
    return adaptive->renderer->progress.tiles_done == adaptive->renderer->progress.tiles;
}

// Traces the groups from `first` on and the samples that seams need. If the observer stops it,
// removes these groups.
static bool adaptive_pass_trace(Adaptive *adaptive, uint32_t first, const SeamSearch *search,
                                const RenderObserver *observer, Error *error)
{
    RefineTree *tree = &adaptive->tree;
    const uint32_t groups = (uint32_t)tree->groups.count - first, cut = ADAPTIVE_CUT * groups;
    const uint32_t count = cut + (uint32_t)search->asked.count;
    if (count == 0)
        return true;
    SamplePlace *places = memory_raw(count, sizeof *places, error);
    SampleData *samples = memory_raw(count, sizeof *samples, error);
    const SampleList list = {places, samples, count};
    Exchange exchange = {tree, first, places, samples};
    bool ok = places != NULL && samples != NULL;
    if (ok) {
        thread_pool_share(adaptive->pool, groups, GROUPS_OF_TASK, list_places, &exchange);
        for (size_t i = 0; i < search->asked.count; i++) {
            uint32_t place[2];
            seam_asks(&tree->seams.data[search->asked.data[i]], place);
            places[cut + i] = (SamplePlace){place[0], place[1]};
        }
        ok = sampler_trace(adaptive->renderer, &adaptive->frame, &list, observer, error);
    }
    if (ok && adaptive_is_whole(adaptive)) {
        thread_pool_share(adaptive->pool, groups, GROUPS_OF_TASK, take_samples, &exchange);
        tree->traced = (uint32_t)tree->groups.count;
        adaptive->samples += count;
        ok = seam_search_take(search, tree, samples + cut, error) &&
             seam_search_open(tree, first, tree->traced, adaptive->pool, error);
    } else {
        refine_tree_uncut(tree, first);
    }
    free(places);
    free(samples);
    return ok;
}

// Each task lists the pixels of one row of blocks.
static void list_pixels(void *context, uint32_t first, uint32_t end)
{
    (void)end;
    const Exchange *exchange = context;
    const RefineTree *tree = exchange->tree;
    const uint32_t half = REFINE_GRID / 2;
    SamplePlace *places = exchange->places + refine_tree_place(tree, 0, first);
    for (uint32_t left = 0; left < tree->columns * PACKET_SIDE; left += PACKET_SIDE)
        for (uint32_t i = 0; i < PACKET_SIDE * PACKET_SIDE; i++) {
            const uint32_t x = left + i % PACKET_SIDE, y = first + i / PACKET_SIDE;
            const bool is_there = x < tree->width && y < tree->height;
            *places++ =
                (SamplePlace){is_there ? REFINE_GRID * x + half : NOTHING, REFINE_GRID * y + half};
        }
}

// Takes one sample per pixel.
static bool adaptive_pass_begin(Adaptive *adaptive, const RenderObserver *observer, Error *error)
{
    RefineTree *tree = &adaptive->tree;
    const uint32_t count = refine_tree_places(tree);
    SamplePlace *places = memory_raw(count, sizeof *places, error);
    const SampleList list = {places, tree->pixels, count};
    if (places == NULL)
        return false;
    Exchange exchange = {.tree = tree, .places = places};
    thread_pool_share(adaptive->pool, tree->height, PACKET_SIDE, list_pixels, &exchange);
    const bool ok = sampler_trace(adaptive->renderer, &adaptive->frame, &list, observer, error);
    adaptive->samples = (uint64_t)tree->width * tree->height;
    free(places);
    return ok && pixel_contrasts_make(&adaptive->pixel_contrasts, tree, adaptive->pool, error);
}

#define ROWS_OF_TASK 16

// The input of a marking pass and its result.
typedef struct {
    const RefineTree *tree;
    const Footprints *footprints;
    const ThinParts *thin_parts;
    float threshold;
    uint32_t first, end; // range of groups
    uint16_t *marks;     // of each group: a bit per cell, then a bit per side
} Marking;

// Returns a bit for each side where the group differs from the cell beyond by more than the
// threshold. The cell beyond has the size of the subdivided cell or is larger.
static unsigned marks_around(const Marking *marking, const CellGroup *group)
{
    unsigned marks = 0;
    for (CellSide side = 0; side < SIDE_COUNT; side++) {
        CellName name;
        const bool is_known = group->beyond_levels[side] + 1u == group->level;
        if (is_known && group->across[side] <= marking->threshold)
            continue;
        if (refine_tree_neighbor(marking->tree, group, side, &name) &&
            contrast_across(group, side, refine_tree_sample(marking->tree, &name), name.level) >
                marking->threshold)
            marks |= 1u << side;
    }
    return marks;
}

static uint16_t marks_of_group(const Marking *marking, const CellGroup *group)
{
    const float threshold = marking->threshold;
    unsigned marks = marks_around(marking, group) << GROUP_CELLS;
    if (group->level == REFINE_LEVELS)
        return (uint16_t)marks;
    marks |=
        footprints_marks(marking->footprints, group) | thin_parts_marks(marking->thin_parts, group);
    for (uint32_t cell = 0; cell < GROUP_CELLS; cell++)
        if (group->groups[cell] == 0 && contrast_read(group->contrasts[cell]).value > threshold)
            marks |= 1u << cell;
    return (uint16_t)marks;
}

static void mark_groups(void *context, uint32_t first, uint32_t end)
{
    const Marking *marking = context;
    const RefineTree *tree = marking->tree;
    for (uint32_t i = first; i < end; i++)
        marking->marks[i] = marks_of_group(marking, &tree->groups.data[marking->first + i]);
}

static bool cut_named(RefineTree *tree, const CellName *name, Error *error)
{
    return name->group == 0 ? refine_tree_cut_pixel(tree, name->cell % tree->width,
                                                    name->cell / tree->width, error)
                            : refine_tree_cut_cell(tree, name->group, name->cell, error);
}

// Subdivides the marked cells around a group, unless another group has done so.
static bool cut_around(RefineTree *tree, uint32_t number, unsigned marks, Error *error)
{
    for (CellSide side = 0; side < SIDE_COUNT; side++) {
        CellName name;
        if ((marks >> (GROUP_CELLS + side) & 1) &&
            refine_tree_neighbor(tree, &tree->groups.data[number], side, &name) &&
            !cut_named(tree, &name, error))
            return false;
    }
    return true;
}

// Subdivides the marked cells of a group, unless a neighboring group has done so.
static bool cut_inside(RefineTree *tree, uint32_t number, unsigned marks, Error *error)
{
    for (uint32_t cell = 0; cell < GROUP_CELLS; cell++)
        if ((marks >> cell & 1) && tree->groups.data[number].groups[cell] == 0 &&
            !refine_tree_cut_cell(tree, number, cell, error))
            return false;
    return true;
}

static bool cut_groups(RefineTree *tree, const Marking *marking, Error *error)
{
    for (uint32_t number = marking->first; number < marking->end; number++) {
        const unsigned marks = marking->marks[number - marking->first];
        if (!cut_inside(tree, number, marks, error) ||
            (marks >> GROUP_CELLS != 0 && !cut_around(tree, number, marks, error)))
            return false;
    }
    return true;
}

static bool cut_footprints(RefineTree *tree, const Footprints *footprints, Error *error)
{
    for (size_t i = 0; i < footprints->list.count; i++) {
        const uint32_t pixel = footprints->list.data[i].pixel;
        if (tree->pixel_groups[pixel] == 0 &&
            !refine_tree_cut_pixel(tree, pixel % tree->width, pixel / tree->width, error))
            return false;
    }
    return true;
}

static bool mark_and_cut_pixels(Adaptive *adaptive, float threshold, Error *error)
{
    const PixelWants wants = {&adaptive->pixel_contrasts, &adaptive->thin_parts, threshold};
    return cut_footprints(&adaptive->tree, &adaptive->footprints, error) &&
           pixel_marks_take(&adaptive->tree, &wants, adaptive->pool, error);
}

// Examines groups first to end - 1.
static bool mark_and_cut_groups(Adaptive *adaptive, float threshold, uint32_t first, uint32_t end,
                                Error *error)
{
    RefineTree *tree = &adaptive->tree;
    Marking marking = {.tree = tree,
                       .footprints = &adaptive->footprints,
                       .thin_parts = &adaptive->thin_parts,
                       .threshold = threshold,
                       .first = first,
                       .end = end};
    if (first >= end || !adaptive_is_whole(adaptive))
        return true;
    marking.marks = memory_raw(end - first, sizeof *marking.marks, error);
    if (marking.marks == NULL)
        return false;
    thread_pool_share(adaptive->pool, end - first, GROUPS_OF_TASK, mark_groups, &marking);
    const bool ok = cut_groups(tree, &marking, error);
    free(marking.marks);
    return ok;
}

static bool cut_all(Adaptive *adaptive, float threshold, Error *error)
{
    const uint32_t end = (uint32_t)adaptive->tree.groups.count;
    return !adaptive_is_whole(adaptive) ||
           (mark_and_cut_pixels(adaptive, threshold, error) &&
            mark_and_cut_groups(adaptive, threshold, 1, end, error));
}

bool adaptive_refine(Adaptive *adaptive, float threshold, const RenderObserver *observer,
                     Error *error)
{
    RefineTree *tree = &adaptive->tree;
    SeamSearch search = {.seen = 1};
    uint32_t first = (uint32_t)tree->groups.count;
    bool ok = cut_all(adaptive, threshold, error);
    for (;;) {
        ok = ok && seam_search_ask(&search, tree, ADAPTIVE_SEAM_PART * threshold, error);
        const uint32_t end = (uint32_t)tree->groups.count;
        if (!ok || !adaptive_is_whole(adaptive) || (first == end && search.asked.count == 0))
            break;
        ok = adaptive_pass_trace(adaptive, first, &search, observer, error) &&
             mark_and_cut_groups(adaptive, threshold, first, end, error);
        first = end;
    }
    seam_search_free(&search);
    return ok;
}

bool adaptive_open(Adaptive *adaptive, const AdaptiveSetup *setup, const RenderObserver *observer,
                   Error *error)
{
    Renderer *renderer = setup->renderer;
    *adaptive = (Adaptive){.renderer = renderer, .pool = setup->pool, .frame = renderer->frame};
    FrameData *frame = &adaptive->frame;
    frame->camera = *setup->camera;
    frame->samples = REFINE_GRID;
    renderer->progress = (RenderProgress){0};
    const ThinSource thin = {frame, setup->scene, setup->normalization, setup->pool};
    const bool ok = refine_tree_make(&adaptive->tree, frame->width, frame->height, error) &&
                    footprints_make(&adaptive->footprints, frame, setup->flat->spheres, error) &&
                    thin_parts_make(&adaptive->thin_parts, &thin, error) &&
                    adaptive_pass_begin(adaptive, observer, error);
    if (!ok)
        adaptive_close(adaptive);
    return ok;
}

typedef struct {
    const RefineTree *tree;
    Framebuffer *framebuffer;
} Storing;

static void store_rows(void *context, uint32_t first, uint32_t end)
{
    const Storing *storing = context;
    const RefineTree *tree = storing->tree;
    for (uint32_t y = first; y < end; y++)
        refine_tree_store_row(tree, y, &storing->framebuffer->pixels[(size_t)y * tree->width]);
}

void adaptive_store(const Adaptive *adaptive, Framebuffer *framebuffer)
{
    Storing storing = {&adaptive->tree, framebuffer};
    thread_pool_share(adaptive->pool, adaptive->tree.height, ROWS_OF_TASK, store_rows, &storing);
}

void adaptive_close(Adaptive *adaptive)
{
    pixel_contrasts_free(&adaptive->pixel_contrasts);
    footprints_free(&adaptive->footprints);
    thin_parts_free(&adaptive->thin_parts);
    refine_tree_free(&adaptive->tree);
    *adaptive = (Adaptive){0};
}
