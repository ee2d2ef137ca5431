// SPDX-License-Identifier: MIT
// Sorts triangles by the grid cell of their center, with a radix sort of two passes. Threads
// process chunks of triangles. Prefix sums over digits and chunks give each chunk its own
// destinations, which keeps the sort stable.
#include "accel/upper.h"

#include <stdlib.h>

#define SIDE_CELLS 64 // cells along the longest side of the grid
#define DIGIT_BITS 9
#define DIGITS     (1 << DIGIT_BITS)

typedef struct {
    uint32_t cell, number;
} CellEntry;

// The cell coordinate on an axis is (doubled center - origin) * scale, rounded down.
typedef struct {
    Float4 origin, scale;
    uint32_t row, layer; // cells per row, cells per layer of rows
} Grid;

typedef struct {
    CellSource source;
    Grid grid;
    CellEntry *entries[2];
    Bounds *centers;            // by chunk: bounds of the doubled centers
    uint32_t (*places)[DIGITS]; // by chunk and digit: triangle counts, later destinations
    uint32_t *cell_counts;      // by chunk: cells that begin in it, later cells before it
    uint32_t shift;             // lowest bit of this pass's digit
    Cells *cells;
} Sorting;

static Bounds bounds_of(const Sorting *sorting, uint32_t number)
{
    return bounds_of_triangle(sorting->source.triangles, number);
}

static void measure_chunk(void *context, uint32_t first, uint32_t end)
{
    const Sorting *sorting = context;
    Bounds centers = bounds_empty();
    for (uint32_t i = first; i < end; i++) {
        const Bounds box = bounds_of(sorting, sorting->source.numbers[i]);
        const Bounds center = bounds_of_center(&box);
        bounds_unite(&centers, &center);
    }
    sorting->centers[first / CHUNK_ELEMENTS] = centers;
}

// Returns a grid of cubic cells, or of one cell if all centers are equal.
static Grid grid_of(const Bounds *centers)
{
    Grid grid = {centers->low, {0}, 1, 1};
    float longest = 0;
    for (int axis = 0; axis < 3; axis++)
        longest = fmaxf(longest, bounds_extent(centers, axis));
    const float scale = (float)SIDE_CELLS * 0.999999f / longest;
    if (!(scale < INFINITY))
        return grid;
    for (int axis = 0; axis < 3; axis++)
        grid.scale[axis] = scale;
    grid.row = (uint32_t)(bounds_extent(centers, 0) * scale) + 1;
    grid.layer = grid.row * ((uint32_t)(bounds_extent(centers, 1) * scale) + 1);
    return grid;
}

static void key_chunk(void *context, uint32_t first, uint32_t end)
{
    const Sorting *sorting = context;
    const Grid *grid = &sorting->grid;
    for (uint32_t i = first; i < end; i++) {
        const uint32_t number = sorting->source.numbers[i];
        const Bounds box = bounds_of(sorting, number);
        const Float4 place = (box.low - box.negated_high - grid->origin) * grid->scale;
        const uint32_t cell =
            (uint32_t)place[0] + (uint32_t)place[1] * grid->row + (uint32_t)place[2] * grid->layer;
        sorting->entries[0][i] = (CellEntry){cell, number};
    }
}

static void count_chunk(void *context, uint32_t first, uint32_t end)
{
    const Sorting *sorting = context;
    uint32_t *counts = sorting->places[first / CHUNK_ELEMENTS];
    for (uint32_t digit = 0; digit < DIGITS; digit++)
        counts[digit] = 0;
    for (uint32_t i = first; i < end; i++)
        counts[sorting->entries[0][i].cell >> sorting->shift & (DIGITS - 1)]++;
}

static void move_chunk(void *context, uint32_t first, uint32_t end)
{
    const Sorting *sorting = context;
    uint32_t *places = sorting->places[first / CHUNK_ELEMENTS];
    for (uint32_t i = first; i < end; i++) {
        const CellEntry entry = sorting->entries[0][i];
        sorting->entries[1][places[entry.cell >> sorting->shift & (DIGITS - 1)]++] = entry;
    }
}

// Turns the counts in places into destinations, ordered by digit and then by chunk.
static void place_digits(Sorting *sorting)
{
    const uint32_t chunks = range_count(sorting->source.count, CHUNK_ELEMENTS);
    uint32_t place = 0;
    for (uint32_t digit = 0; digit < DIGITS; digit++)
        for (uint32_t chunk = 0; chunk < chunks; chunk++) {
            const uint32_t count = sorting->places[chunk][digit];
            sorting->places[chunk][digit] = place;
            place += count;
        }
}

static void sort(Sorting *sorting, ThreadPool *pool)
{
    const uint32_t count = sorting->source.count;
    for (sorting->shift = 0; sorting->shift < 2 * DIGIT_BITS; sorting->shift += DIGIT_BITS) {
        thread_pool_share(pool, count, CHUNK_ELEMENTS, count_chunk, sorting);
        place_digits(sorting);
        thread_pool_share(pool, count, CHUNK_ELEMENTS, move_chunk, sorting);
        CellEntry *sorted = sorting->entries[1];
        sorting->entries[1] = sorting->entries[0];
        sorting->entries[0] = sorted;
    }
}

static bool begins_cell(const CellEntry *entries, uint32_t place)
{
    return place == 0 || entries[place - 1].cell != entries[place].cell;
}

static void count_cells(void *context, uint32_t first, uint32_t end)
{
    const Sorting *sorting = context;
    uint32_t count = 0;
    for (uint32_t i = first; i < end; i++)
        count += begins_cell(sorting->entries[0], i);
    sorting->cell_counts[first / CHUNK_ELEMENTS] = count;
}

// Makes the cell whose triangles begin at position `first`. Returns where the next cell begins.
static uint32_t make_cell(const Sorting *sorting, uint32_t number, uint32_t first)
{
    const CellEntry *entries = sorting->entries[0];
    BuildItem *item = &sorting->cells->items[number];
    uint32_t place = first;
    Bounds bounds = bounds_empty();
    do {
        const Bounds triangle = bounds_of(sorting, entries[place].number);
        bounds_unite(&bounds, &triangle);
        sorting->cells->numbers[place] = entries[place].number;
        place++;
    } while (place < sorting->source.count && entries[place].cell == entries[first].cell);
    item->bounds = bounds;
    item->number = number;
    item->weight = place - first;
    sorting->cells->starts[number] = first;
    return place;
}

static void make_cells(void *context, uint32_t first, uint32_t end)
{
    const Sorting *sorting = context;
    uint32_t number = sorting->cell_counts[first / CHUNK_ELEMENTS];
    while (first < end && !begins_cell(sorting->entries[0], first))
        first++;
    while (first < end)
        first = make_cell(sorting, number++, first);
}

static bool gather_cells(Sorting *sorting, ThreadPool *pool, Error *error)
{
    Cells *cells = sorting->cells;
    const uint32_t chunks = range_count(sorting->source.count, CHUNK_ELEMENTS);
    thread_pool_share(pool, sorting->source.count, CHUNK_ELEMENTS, count_cells, sorting);
    for (uint32_t chunk = 0; chunk < chunks; chunk++) {
        const uint32_t count = sorting->cell_counts[chunk];
        sorting->cell_counts[chunk] = cells->count;
        cells->count += count;
    }
    cells->items = memory_raw(cells->count, sizeof *cells->items, error);
    cells->starts = memory_raw(cells->count + 1, sizeof *cells->starts, error);
    cells->numbers = memory_raw(sorting->source.count, sizeof *cells->numbers, error);
    if (cells->items == NULL || cells->starts == NULL || cells->numbers == NULL)
        return false;
    thread_pool_share(pool, sorting->source.count, CHUNK_ELEMENTS, make_cells, sorting);
    cells->starts[cells->count] = sorting->source.count;
    return true;
}

static bool allocate(Sorting *sorting, Error *error)
{
    const uint32_t chunks = range_count(sorting->source.count, CHUNK_ELEMENTS);
    sorting->entries[0] = memory_raw(sorting->source.count, sizeof(CellEntry), error);
    sorting->entries[1] = memory_raw(sorting->source.count, sizeof(CellEntry), error);
    sorting->centers = memory_raw(chunks, sizeof *sorting->centers, error);
    sorting->places = memory_raw(chunks, sizeof *sorting->places, error);
    sorting->cell_counts = memory_raw(chunks, sizeof *sorting->cell_counts, error);
    return sorting->entries[0] != NULL && sorting->entries[1] != NULL && sorting->centers != NULL &&
           sorting->places != NULL && sorting->cell_counts != NULL;
}

static bool sort_and_gather(Sorting *sorting, ThreadPool *pool, Error *error)
{
    const uint32_t chunks = range_count(sorting->source.count, CHUNK_ELEMENTS);
    Bounds centers = bounds_empty();
    thread_pool_share(pool, sorting->source.count, CHUNK_ELEMENTS, measure_chunk, sorting);
    for (uint32_t chunk = 0; chunk < chunks; chunk++)
        bounds_unite(&centers, &sorting->centers[chunk]);
    sorting->grid = grid_of(&centers);
    thread_pool_share(pool, sorting->source.count, CHUNK_ELEMENTS, key_chunk, sorting);
    sort(sorting, pool);
    return gather_cells(sorting, pool, error);
}

bool cells_make(Cells *cells, const CellSource *source, ThreadPool *pool, Error *error)
{
    Sorting sorting = {.source = *source, .cells = cells};
    *cells = (Cells){0};
    const bool ok = allocate(&sorting, error) && sort_and_gather(&sorting, pool, error);
    free(sorting.entries[0]);
    free(sorting.entries[1]);
    free(sorting.centers);
    free(sorting.places);
    free(sorting.cell_counts);
    if (!ok)
        cells_free(cells);
    return ok;
}

void cells_free(Cells *cells)
{
    free(cells->items);
    free(cells->starts);
    free(cells->numbers);
    *cells = (Cells){0};
}
