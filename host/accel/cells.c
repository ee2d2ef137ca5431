// SPDX-License-Identifier: MIT
// Sorts triangles by the grid cell of their center, with a radix sort of two passes. Threads
// process chunks of triangles. Prefix sums over digits and chunks give each chunk its own
// destinations, which keeps the sort stable.
#include "accel/cells.h"

#include <stdlib.h>

#define SIDE_CELLS 64 // cells along the longest side of the grid
#define DIGIT_BITS 9
#define DIGITS     (1 << DIGIT_BITS)

typedef struct {
    uint32_t cell, number;
} Keyed;

// The cell coordinate on an axis is (doubled center - origin) * scale, rounded down.
typedef struct {
    Float4 origin, scale;
    uint32_t row, layer; // cells per row, cells per layer of rows
} Grid;

typedef struct {
    CellSource source;
    Grid grid;
    Keyed *keyed[2];
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

static void measure_chunk(void *context, uint32_t chunk, uint32_t worker)
{
    const Sorting *sorting = context;
    const uint32_t end = chunk_end(chunk, sorting->source.count);
    Bounds centers = bounds_empty();
    (void)worker;
    for (uint32_t i = chunk * CHUNK_ELEMENTS; i < end; i++) {
        const Bounds box = bounds_of(sorting, sorting->source.numbers[i]);
        const Bounds center = bounds_of_center(&box);
        bounds_unite(&centers, &center);
    }
    sorting->centers[chunk] = centers;
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

static void key_chunk(void *context, uint32_t chunk, uint32_t worker)
{
    const Sorting *sorting = context;
    const Grid *grid = &sorting->grid;
    const uint32_t end = chunk_end(chunk, sorting->source.count);
    (void)worker;
    for (uint32_t i = chunk * CHUNK_ELEMENTS; i < end; i++) {
        const uint32_t number = sorting->source.numbers[i];
        const Bounds box = bounds_of(sorting, number);
        const Float4 place = (box.low - box.negated_high - grid->origin) * grid->scale;
        const uint32_t cell =
            (uint32_t)place[0] + (uint32_t)place[1] * grid->row + (uint32_t)place[2] * grid->layer;
        sorting->keyed[0][i] = (Keyed){cell, number};
    }
}

static void count_chunk(void *context, uint32_t chunk, uint32_t worker)
{
    const Sorting *sorting = context;
    const uint32_t end = chunk_end(chunk, sorting->source.count);
    uint32_t *counts = sorting->places[chunk];
    (void)worker;
    for (uint32_t digit = 0; digit < DIGITS; digit++)
        counts[digit] = 0;
    for (uint32_t i = chunk * CHUNK_ELEMENTS; i < end; i++)
        counts[sorting->keyed[0][i].cell >> sorting->shift & (DIGITS - 1)]++;
}

static void move_chunk(void *context, uint32_t chunk, uint32_t worker)
{
    const Sorting *sorting = context;
    const uint32_t end = chunk_end(chunk, sorting->source.count);
    uint32_t *places = sorting->places[chunk];
    (void)worker;
    for (uint32_t i = chunk * CHUNK_ELEMENTS; i < end; i++) {
        const Keyed keyed = sorting->keyed[0][i];
        sorting->keyed[1][places[keyed.cell >> sorting->shift & (DIGITS - 1)]++] = keyed;
    }
}

// Turns the counts in places into destinations, ordered by digit and then by chunk.
static void place_digits(Sorting *sorting)
{
    const uint32_t chunks = chunk_count(sorting->source.count);
    uint32_t place = 0;
    for (uint32_t digit = 0; digit < DIGITS; digit++)
        for (uint32_t chunk = 0; chunk < chunks; chunk++) {
            const uint32_t count = sorting->places[chunk][digit];
            sorting->places[chunk][digit] = place;
            place += count;
        }
}

static void sort(Sorting *sorting, Crew *crew)
{
    const uint32_t chunks = chunk_count(sorting->source.count);
    for (sorting->shift = 0; sorting->shift < 2 * DIGIT_BITS; sorting->shift += DIGIT_BITS) {
        crew_run(crew, chunks, count_chunk, sorting);
        place_digits(sorting);
        crew_run(crew, chunks, move_chunk, sorting);
        Keyed *sorted = sorting->keyed[1];
        sorting->keyed[1] = sorting->keyed[0];
        sorting->keyed[0] = sorted;
    }
}

static bool begins_cell(const Keyed *keyed, uint32_t place)
{
    return place == 0 || keyed[place - 1].cell != keyed[place].cell;
}

static void count_cells(void *context, uint32_t chunk, uint32_t worker)
{
    const Sorting *sorting = context;
    const uint32_t end = chunk_end(chunk, sorting->source.count);
    uint32_t count = 0;
    (void)worker;
    for (uint32_t i = chunk * CHUNK_ELEMENTS; i < end; i++)
        count += begins_cell(sorting->keyed[0], i);
    sorting->cell_counts[chunk] = count;
}

// Makes the cell whose triangles begin at position `first`. Returns where the next cell begins.
static uint32_t make_cell(const Sorting *sorting, uint32_t number, uint32_t first)
{
    const Keyed *keyed = sorting->keyed[0];
    BuildItem *item = &sorting->cells->items[number];
    uint32_t place = first;
    Bounds bounds = bounds_empty();
    do {
        const Bounds triangle = bounds_of(sorting, keyed[place].number);
        bounds_unite(&bounds, &triangle);
        sorting->cells->numbers[place] = keyed[place].number;
        place++;
    } while (place < sorting->source.count && keyed[place].cell == keyed[first].cell);
    item->bounds = bounds;
    item->number = number;
    item->weight = place - first;
    sorting->cells->starts[number] = first;
    return place;
}

static void make_cells(void *context, uint32_t chunk, uint32_t worker)
{
    const Sorting *sorting = context;
    const uint32_t end = chunk_end(chunk, sorting->source.count);
    uint32_t number = sorting->cell_counts[chunk];
    uint32_t place = chunk * CHUNK_ELEMENTS;
    (void)worker;
    while (place < end && !begins_cell(sorting->keyed[0], place))
        place++;
    while (place < end)
        place = make_cell(sorting, number++, place);
}

static bool gather_cells(Sorting *sorting, Crew *crew, Error *error)
{
    Cells *cells = sorting->cells;
    const uint32_t chunks = chunk_count(sorting->source.count);
    crew_run(crew, chunks, count_cells, sorting);
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
    crew_run(crew, chunks, make_cells, sorting);
    cells->starts[cells->count] = sorting->source.count;
    return true;
}

static bool allocate(Sorting *sorting, Error *error)
{
    const uint32_t chunks = chunk_count(sorting->source.count);
    sorting->keyed[0] = memory_raw(sorting->source.count, sizeof(Keyed), error);
    sorting->keyed[1] = memory_raw(sorting->source.count, sizeof(Keyed), error);
    sorting->centers = memory_raw(chunks, sizeof *sorting->centers, error);
    sorting->places = memory_raw(chunks, sizeof *sorting->places, error);
    sorting->cell_counts = memory_raw(chunks, sizeof *sorting->cell_counts, error);
    return sorting->keyed[0] != NULL && sorting->keyed[1] != NULL && sorting->centers != NULL &&
           sorting->places != NULL && sorting->cell_counts != NULL;
}

static bool sort_and_gather(Sorting *sorting, Crew *crew, Error *error)
{
    const uint32_t chunks = chunk_count(sorting->source.count);
    Bounds centers = bounds_empty();
    crew_run(crew, chunks, measure_chunk, sorting);
    for (uint32_t chunk = 0; chunk < chunks; chunk++)
        bounds_unite(&centers, &sorting->centers[chunk]);
    sorting->grid = grid_of(&centers);
    crew_run(crew, chunks, key_chunk, sorting);
    sort(sorting, crew);
    return gather_cells(sorting, crew, error);
}

bool cells_make(Cells *cells, const CellSource *source, Crew *crew, Error *error)
{
    Sorting sorting = {.source = *source, .cells = cells};
    *cells = (Cells){0};
    const bool ok = allocate(&sorting, error) && sort_and_gather(&sorting, crew, error);
    free(sorting.keyed[0]);
    free(sorting.keyed[1]);
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
