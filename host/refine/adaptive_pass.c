// SPDX-License-Identifier: MIT
// A list contains eight samples per new group, in the order of the groups, then one per seam that
// needs a sample.
#include "refine/adaptive.h"

#include "refine/pixel_contrast.h"
#include "render/sampler.h"

#include <stdlib.h>

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

bool adaptive_pass_trace(Adaptive *adaptive, uint32_t first, const SeamSearch *search,
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

bool adaptive_pass_begin(Adaptive *adaptive, const RenderObserver *observer, Error *error)
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
