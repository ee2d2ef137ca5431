// SPDX-License-Identifier: MIT
// Each pass marks cells in parallel, subdivides the marked cells in order, and traces all new
// samples as one list. The next pass examines only the new groups of cells, their neighbors, and
// the seams that are new or that this pass has listed.
#include "refine/adaptive.h"

#include "refine/contrast.h"
#include "refine/seam_search.h"

#include <stdlib.h>

// The number of new samples of a subdivided cell.
#define NEW_SAMPLES (GROUP_CELLS - 1)

// A seam is bisected until its contrast is at most this fraction of the threshold. The fraction is
// small, because halving takes one sample, and subdividing a cell takes eight.
#define SEAM_PART 0.17f

// A pass lists eight samples for each new group, in the order of the groups, and then one sample
// for each listed seam.

#define GROUPS_OF_TASK 512

// The samples of a pass: of all pixels at first, and later of the groups from `first` on.
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
    SamplePlace *places = exchange->places + (size_t)first * NEW_SAMPLES;
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
    const SampleData *samples = exchange->samples + (size_t)first * NEW_SAMPLES;
    for (uint32_t i = first; i < end; i++) {
        CellGroup *group = &tree->groups.data[exchange->first + i];
        for (uint32_t cell = 0; cell < GROUP_CELLS; cell++)
            if (cell != GROUP_MIDDLE)
                group->cells[cell] = *samples++;
    }
}

// Returns false if the observer has stopped a pass.
static bool is_whole(const Adaptive *adaptive)
{
    return adaptive->renderer->progress.tiles_done == adaptive->renderer->progress.tiles;
}

// Traces the samples of the groups from `first` on and of the listed seams. If the observer stops
// the pass, removes these groups.
static bool trace_pass(Adaptive *adaptive, uint32_t first, const SeamSearch *search,
                       const RenderObserver *observer, Error *error)
{
    RefineTree *tree = &adaptive->tree;
    const uint32_t groups = (uint32_t)tree->groups.count - first, cut = NEW_SAMPLES * groups;
    const uint32_t count = cut + (uint32_t)search->asked.count;
    SamplePlace *places = memory_raw(count, sizeof *places, error);
    SampleData *samples = memory_raw(count, sizeof *samples, error);
    const SampleList list = {places, samples, count, 0};
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
    if (ok && is_whole(adaptive)) {
        thread_pool_share(adaptive->pool, groups, GROUPS_OF_TASK, take_samples, &exchange);
        adaptive->samples += count;
        ok = seam_search_take(search, tree, samples + cut, error) &&
             seam_search_open(tree, first, error);
    } else {
        refine_tree_uncut(tree, first);
    }
    free(places);
    free(samples);
    return ok;
}

// Lists the pixels of one row of blocks.
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
static bool trace_pixels(Adaptive *adaptive, const RenderObserver *observer, Error *error)
{
    RefineTree *tree = &adaptive->tree;
    const uint32_t count = refine_tree_places(tree);
    SamplePlace *places = memory_raw(count, sizeof *places, error);
    const SampleList list = {places, tree->pixels, count, 0};
    if (places == NULL)
        return false;
    Exchange exchange = {.tree = tree, .places = places};
    thread_pool_share(adaptive->pool, tree->height, PACKET_SIDE, list_pixels, &exchange);
    const bool ok = sampler_trace(adaptive->renderer, &adaptive->frame, &list, observer, error);
    adaptive->samples = (uint64_t)tree->width * tree->height;
    free(places);
    return ok;
}

// Traces new groups and listed seams, pass by pass, until neither groups nor seams remain.
static bool refine(Adaptive *adaptive, SeamSearch *search, float threshold,
                   const RenderObserver *observer, Error *error)
{
    RefineTree *tree = &adaptive->tree;
    const CutRule rule = {&adaptive->thin_parts, threshold};
    uint32_t first = (uint32_t)tree->groups.count;
    bool ok = contrast_cut_pixels(tree, &rule, adaptive->pool, error);
    while (ok && (first < tree->groups.count || search->asked.count > 0)) {
        const uint32_t end = (uint32_t)tree->groups.count;
        ok = trace_pass(adaptive, first, search, observer, error);
        if (!ok || !is_whole(adaptive))
            break;
        ok = contrast_cut_groups(tree, &rule, first, adaptive->pool, error) &&
             seam_search_ask(search, tree, SEAM_PART * threshold, error);
        first = end;
    }
    return ok;
}

bool adaptive_refine(Adaptive *adaptive, float threshold, const RenderObserver *observer,
                     Error *error)
{
    SeamSearch search = {.seen = 1};
    const bool ok = !is_whole(adaptive) || refine(adaptive, &search, threshold, observer, error);
    seam_search_free(&search);
    return ok;
}

#define ROWS_OF_TASK 16

bool adaptive_open(Adaptive *adaptive, const AdaptiveSetup *setup, const RenderObserver *observer,
                   Error *error)
{
    Renderer *renderer = setup->renderer;
    *adaptive = (Adaptive){.renderer = renderer,
                           .pool = setup->pool,
                           .frame = renderer_frame(renderer, setup->camera)};
    FrameData *frame = &adaptive->frame;
    frame->samples = REFINE_GRID;
    renderer->progress = (RenderProgress){0};
    const ThinSource thin = {frame,       setup->scene, setup->normalization, setup->flat->spheres,
                             setup->pool, REFINE_LEVELS};
    const bool ok = refine_tree_make(&adaptive->tree, frame->width, frame->height, error) &&
                    thin_parts_make(&adaptive->thin_parts, &thin, error) &&
                    trace_pixels(adaptive, observer, error);
    if (!ok)
        adaptive_close(adaptive);
    return ok;
}

typedef struct {
    const RefineTree *tree;
    Framebuffer *framebuffer;
} MeanStoring;

static void store_rows(void *context, uint32_t first, uint32_t end)
{
    const MeanStoring *storing = context;
    const RefineTree *tree = storing->tree;
    for (uint32_t y = first; y < end; y++)
        refine_tree_store_row(tree, y, &storing->framebuffer->pixels[(size_t)y * tree->width]);
}

void adaptive_store(const Adaptive *adaptive, Framebuffer *framebuffer)
{
    MeanStoring storing = {&adaptive->tree, framebuffer};
    thread_pool_share(adaptive->pool, adaptive->tree.height, ROWS_OF_TASK, store_rows, &storing);
}

void adaptive_close(Adaptive *adaptive)
{
    thin_parts_free(&adaptive->thin_parts);
    refine_tree_free(&adaptive->tree);
    *adaptive = (Adaptive){0};
}
