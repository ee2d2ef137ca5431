// SPDX-License-Identifier: MIT
// Searches piece by piece, in three steps. Threads first record the pixels whose samples lie in the
// piece. They then list the thin triangles of each pixel at which the piece is not wide
// (thin_parts.h). Finally, they search these pixels level by level, with a mask of cells for each
// row.
//
// Invariant: all results are sets, so they do not depend on the order of work.
#include "refine/thin_triangles.h"

#include "refine/mesh_pieces.h"
#include "refine/thin_cells.h"

#include <stdatomic.h>
#include <stdlib.h>

#define TRIANGLES_OF_TASK 1024
#define RUNS_OF_TASK      64

typedef struct {
    uint32_t pixel, triangle;
} PixelTriangle;

// The indices of the pairs of one pixel: `first` to `end` - 1.
typedef struct {
    uint32_t first, end;
} PixelRun;

// To save memory, a piece with too many pairs is searched only at level 0. The limit is PAIRS_MOST
// pairs, or PAIRS_OF_PIXEL pairs per pixel of the picture if that is more. The estimate of the
// number of pairs is AROUND for each pixel that a thin triangle touches, unless the piece is wide
// at the pixel.
#define PAIRS_MOST     ((uint64_t)1 << 24)
#define PAIRS_OF_PIXEL 32
#define AROUND         9

// The pairs of a range of triangles, or the error that ended the search.
typedef struct {
    ARRAY(PixelTriangle) pairs;
    Error error;
} PairList;

typedef struct {
    ThinParts *parts;
    const ThinSource *source;
    Projection projection;      // of the mesh
    MeshPieces pieces;          // of the mesh
    uint32_t first, count;      // the piece's triangles, in the order of the pieces
    uint32_t number;            // of the piece, from 1
    _Atomic uint32_t *covered;  // by pixel: the latest piece that contains its sample
    _Atomic uint32_t *touched;  // by pixel: the latest piece that is thin there
    _Atomic uint64_t nearby;    // an estimate of the number of pairs (AROUND)
    PairList *lists;            // of each range
    ARRAY(PixelTriangle) pairs; // of the piece, sorted by pixel
    ARRAY(PixelRun) runs;       // of all pixels with pairs
    uint32_t level;             // the level that is being searched
    _Atomic uint64_t cuts;      // cells added at this level
} ThinSearch;

static uint32_t triangle_at(const ThinSearch *search, uint32_t place)
{
    const uint32_t *order = search->pieces.order;
    return order == NULL ? search->first + place : order[search->first + place];
}

static CellGrid pixels_of(const ThinSearch *search)
{
    const ThinParts *parts = search->parts;
    return (CellGrid){REFINE_GRID, 1.0 / REFINE_GRID, {parts->width, parts->height}, {0, 0}};
}

// Records the pixels whose samples lie in the triangles.
static void cover_pixels(void *context, uint32_t first, uint32_t end)
{
    const ThinSearch *search = context;
    const CellGrid grid = pixels_of(search);
    for (uint32_t i = first; i < end; i++) {
        Outline outline;
        if (!projection_outline(&search->projection, triangle_at(search, i), &outline))
            continue;
        const CellRange rows = box_sampled(&outline.box, &grid, 1);
        for (uint32_t row = rows.first; row < rows.end; row++) {
            const CellRange columns = outline_sampled(&outline, &grid, row);
            for (uint32_t column = columns.first; column < columns.end; column++)
                atomic_store_explicit(&search->covered[(size_t)row * grid.counts[0] + column],
                                      search->number, memory_order_relaxed);
        }
    }
}

static bool is_covered(const ThinSearch *search, uint32_t column, uint32_t row)
{
    const ThinParts *parts = search->parts;
    return column < parts->width && row < parts->height &&
           atomic_load_explicit(&search->covered[(size_t)row * parts->width + column],
                                memory_order_relaxed) == search->number;
}

// Returns whether the piece is wide at a pixel. The piece is wide if four covered pixels form a
// square that contains or touches the pixel. On each axis, squares that contain it come first.
static bool is_wide(const ThinSearch *search, uint32_t column, uint32_t row)
{
    static const int steps[4] = {-1, 0, -2, 1};
    for (int i = 0; i < 16; i++) {
        const uint32_t x = column + (uint32_t)steps[i % 4], y = row + (uint32_t)steps[i / 4];
        if (is_covered(search, x, y) && is_covered(search, x + 1, y + 1) &&
            is_covered(search, x, y + 1) && is_covered(search, x + 1, y))
            return true;
    }
    return false;
}

// Computes the outline of a triangle that is thin at level 0. Returns false for other triangles.
static bool thin_outline(const ThinSearch *search, uint32_t triangle, Outline *outline)
{
    return projection_outline(&search->projection, triangle, outline) && thin_at_level(outline, 0);
}

// If the piece is thin at a pixel that the triangle touches, lists the pixel, but only once per
// piece. Adds the triangle's estimated pairs to search->nearby.
static bool list_touched(ThinSearch *search, uint32_t triangle, PairList *list)
{
    const CellGrid grid = pixels_of(search);
    Outline outline;
    uint64_t nearby = 0;
    if (!thin_outline(search, triangle, &outline))
        return true;
    const CellRange rows = box_touched(&outline.box, &grid, 1);
    for (uint32_t row = rows.first; row < rows.end; row++) {
        const CellRange columns = outline_touched(&outline, &grid, row);
        for (uint32_t column = columns.first; column < columns.end; column++) {
            const PixelTriangle pair = {row * grid.counts[0] + column, triangle};
            if (is_wide(search, column, row))
                continue;
            nearby += AROUND;
            if (search->touched[pair.pixel] != search->number &&
                atomic_exchange(&search->touched[pair.pixel], search->number) != search->number &&
                !array_push(&list->pairs, pair, &list->error))
                return false;
        }
    }
    search->nearby += nearby;
    return true;
}

// Adds a pair for each pixel at which the piece is thin, if the triangle touches the pixel or its
// margin.
static bool list_near(ThinSearch *search, uint32_t triangle, PairList *list)
{
    const double reach = MARGIN * (double)refine_tree_cell_side(1);
    const CellGrid grid = pixels_of(search);
    Outline outline;
    if (!thin_outline(search, triangle, &outline))
        return true;
    const CellRange rows =
        cells_touched(outline.box.low[1] - reach, outline.box.high[1] + reach, &grid, 1);
    for (uint32_t row = rows.first; row < rows.end; row++) {
        const CellRange columns = outline_near(&outline, &grid, row, reach);
        for (uint32_t column = columns.first; column < columns.end; column++) {
            const PixelTriangle pair = {row * grid.counts[0] + column, triangle};
            if (search->touched[pair.pixel] == search->number &&
                !array_push(&list->pairs, pair, &list->error))
                return false;
        }
    }
    return true;
}

static void list_all_touched(void *context, uint32_t first, uint32_t end)
{
    ThinSearch *search = context;
    PairList *list = &search->lists[first / TRIANGLES_OF_TASK];
    for (uint32_t i = first; i < end; i++)
        if (!list_touched(search, triangle_at(search, i), list))
            return;
}

static void list_all_near(void *context, uint32_t first, uint32_t end)
{
    ThinSearch *search = context;
    PairList *list = &search->lists[first / TRIANGLES_OF_TASK];
    for (uint32_t i = first; i < end; i++)
        if (!list_near(search, triangle_at(search, i), list))
            return;
}

static bool append_list(ThinSearch *search, const PairList *list, Error *error)
{
    if (list->error.text[0] != '\0')
        return error_set(error, "%s", list->error.text);
    for (size_t i = 0; i < list->pairs.count; i++)
        if (!array_push(&search->pairs, list->pairs.data[i], error))
            return false;
    return true;
}

static int compare_pixels(const void *a, const void *b)
{
    const uint32_t one = ((const PixelTriangle *)a)->pixel;
    const uint32_t other = ((const PixelTriangle *)b)->pixel;
    return (one > other) - (one < other);
}

// Runs `list` on all triangles of the piece, and collects the pairs.
static bool collect(ThinSearch *search, ThreadPoolPart *list, Error *error)
{
    const uint32_t tasks = range_count(search->count, TRIANGLES_OF_TASK);
    search->lists = memory_zeroed(tasks, sizeof *search->lists, error);
    search->pairs.count = 0;
    bool ok = search->lists != NULL;
    if (ok)
        thread_pool_share(search->source->pool, search->count, TRIANGLES_OF_TASK, list, search);
    for (uint32_t task = 0; search->lists != NULL && task < tasks; task++) {
        ok = ok && append_list(search, &search->lists[task], error);
        free(search->lists[task].pairs.data);
    }
    free(search->lists);
    return ok;
}

// Sorts the pairs into runs of one pixel each.
static bool find_runs(ThinSearch *search, Error *error)
{
    const PixelTriangle *pairs = search->pairs.data;
    const uint32_t count = (uint32_t)search->pairs.count;
    search->runs.count = 0;
    qsort(search->pairs.data, count, sizeof *search->pairs.data, compare_pixels);
    for (uint32_t i = 0; i < count;) {
        PixelRun run = {i, i};
        while (run.end < count && pairs[run.end].pixel == pairs[i].pixel)
            run.end++;
        if (!array_push(&search->runs, run, error))
            return false;
        i = run.end;
    }
    return true;
}

// Returns a mask of the row's cells whose parents are subdivided.
static uint32_t allowed_cells(const uint32_t *parents, uint32_t row, uint32_t scale)
{
    uint32_t allowed = 0;
    for (uint32_t column = 0; column < scale; column++)
        allowed |= (parents[row / GROUP_SIDE] >> column / GROUP_SIDE & 1) << column;
    return allowed;
}

static bool any_cell(const uint32_t *rows, uint32_t count)
{
    uint32_t any = 0;
    for (uint32_t row = 0; row < count; row++)
        any |= rows[row];
    return any != 0;
}

// Adds the cells to subdivide in one pixel.
static void search_pixel(ThinSearch *search, uint32_t run)
{
    const uint32_t level = search->level, scale = thin_parts_scale(level);
    const PixelRun *pairs = &search->runs.data[run];
    const uint32_t pixel = search->pairs.data[pairs->first].pixel;
    const CellGrid grid = thin_parts_grid(search->parts, pixel, level, MARGIN);
    LocalCells cells = {0};
    const uint32_t *parents = thin_parts_rows(search->parts, pixel, level - 1);
    if (!any_cell(parents, scale / GROUP_SIDE))
        return;
    for (uint32_t i = pairs->first; i < pairs->end; i++) {
        Outline outline;
        if (projection_outline(&search->projection, search->pairs.data[i].triangle, &outline))
            local_cells_add(&cells, &outline, &grid, level);
    }
    uint32_t *rows = thin_parts_rows(search->parts, pixel, level);
    for (uint32_t row = 0; row < scale; row++)
        search->cuts += thin_row_add(&rows[row], (uint32_t)(cells.touched[row + MARGIN] >> MARGIN) &
                                                     ~local_cells_wide(&cells, row) &
                                                     allowed_cells(parents, row, scale));
}

static void search_pixels(void *context, uint32_t first, uint32_t end)
{
    for (uint32_t run = first; run < end; run++)
        search_pixel(context, run);
}

// Adds the pixels at which the piece is thin.
static bool add_pixels(ThinSearch *search, Error *error)
{
    ThinParts *parts = search->parts;
    search->nearby = 0;
    if (!collect(search, list_all_touched, error))
        return false;
    for (size_t i = 0; i < search->pairs.count; i++)
        thin_parts_add_pixel(parts, search->pairs.data[i].pixel);
    if (!thin_parts_make_room(parts, 0, error))
        return false;
    for (size_t i = 0; i < search->pairs.count; i++)
        parts->cuts[0] += thin_row_add(thin_parts_rows(parts, search->pairs.data[i].pixel, 0), 1);
    return true;
}

// Adds smaller cells, level by level, in the pixels at which the piece is thin.
static bool add_cells(ThinSearch *search, Error *error)
{
    ThinParts *parts = search->parts;
    bool ok = collect(search, list_all_near, error) && find_runs(search, error);
    for (search->level = 1; ok && search->level < thin_parts_affordable(parts); search->level++) {
        ok = thin_parts_make_room(parts, search->level, error);
        search->cuts = 0;
        if (ok)
            thread_pool_share(search->source->pool, (uint32_t)search->runs.count, RUNS_OF_TASK,
                              search_pixels, search);
        parts->cuts[search->level] += search->cuts;
    }
    return ok;
}

static uint64_t most_pairs(const ThinParts *parts)
{
    const uint64_t most = (uint64_t)PAIRS_OF_PIXEL * parts->width * parts->height;
    return most > PAIRS_MOST ? most : PAIRS_MOST;
}

static bool search_piece(ThinSearch *search, uint32_t end, Error *error)
{
    const uint64_t most = most_pairs(search->parts);
    search->count = end - search->first;
    search->number++;
    thread_pool_share(search->source->pool, search->count, TRIANGLES_OF_TASK, cover_pixels, search);
    const bool ok = add_pixels(search, error) &&
                    (search->pairs.count == 0 || search->nearby > most ||
                     thin_parts_affordable(search->parts) < 2 || add_cells(search, error));
    search->first = end;
    return ok;
}

static bool search_mesh(ThinSearch *search, const MeshObject *object, Error *error)
{
    const ThinSource *source = search->source;
    search->pieces = (MeshPieces){0};
    search->first = 0;
    bool ok = projection_begin(&search->projection, object, source->pool, error) &&
              mesh_pieces_make(&search->pieces, &object->mesh, error);
    for (uint32_t i = 0; ok && i < search->pieces.count; i++)
        ok = search_piece(search, search->pieces.ends[i], error);
    mesh_pieces_free(&search->pieces);
    projection_end(&search->projection);
    return ok;
}

bool thin_triangles_find(ThinParts *parts, const ThinSource *source, Error *error)
{
    ThinSearch search = {.parts = parts,
                         .source = source,
                         .projection = projection_of(source->frame, source->normalization)};
    const size_t pixels = (size_t)parts->width * parts->height;
    if (source->scene->objects.count == 0)
        return true;
    search.covered = memory_zeroed(pixels, sizeof *search.covered, error);
    search.touched = memory_zeroed(pixels, sizeof *search.touched, error);
    bool ok = search.covered != NULL && search.touched != NULL;
    for (size_t i = 0; ok && i < source->scene->objects.count; i++)
        ok = search_mesh(&search, &source->scene->objects.data[i], error);
    free(search.covered);
    free(search.touched);
    free(search.pairs.data);
    free(search.runs.data);
    return ok;
}
