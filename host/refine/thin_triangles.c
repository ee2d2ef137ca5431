// SPDX-License-Identifier: MIT
// Searches piece by piece, in three steps. Threads first record the pixels whose centers lie in the
// piece. They then list the thin triangles of each pixel at which the piece is not wide
// (thin_parts.h). Finally, they draw these triangles on the pixel's grid of places, and choose
// probes level by level.
//
// Invariant: all results are sets, so they do not depend on the order of work.
#include "refine/thin_triangles.h"

#include "refine/mesh_pieces.h"
#include "refine/thin_drawing.h"

#include <stdatomic.h>
#include <stdlib.h>

#define TRIANGLES_OF_TASK 1024
#define RUNS_OF_TASK      64

typedef struct {
    uint32_t pixel, triangle;
} PixelTriangle;

// The pairs with one pixel: elements `first` to `end` - 1 of ThinSearch::pairs.
typedef struct {
    uint32_t first, end;
    ThinAxis axis; // of the pixel's lines
} PixelRun;

// To save memory, a piece with too many pairs of pixels and triangles has no probes. The limit is
// PAIRS_MOST or, if this is more, PAIRS_OF_PIXEL times the number of pixels in the picture.
#define PAIRS_MOST     ((uint64_t)1 << 24)
#define PAIRS_OF_PIXEL 32

// The results of a task, or the error that ended it.
typedef struct {
    ARRAY(PixelTriangle) pairs;
    ProbeList probes;
    Error error;
} TaskList;

typedef struct {
    ThinParts *parts;
    const ThinSource *source;
    Projection projection;      // of the mesh
    MeshPieces pieces;          // of the mesh
    uint32_t first, count;      // the piece's triangles, in the order of the pieces
    uint32_t number;            // of the piece, from 1
    uint32_t levels;            // number of levels to search for probes
    _Atomic uint32_t *covered;  // by pixel: the latest piece that contains the pixel's center
    _Atomic uint32_t *touched;  // by pixel: the latest piece whose thin triangles touch it
    _Atomic uint64_t met;       // pairs of thin triangles and pixels that they touch
    TaskList *lists;            // of each task
    ARRAY(PixelTriangle) pairs; // of the piece, sorted by pixel
    ARRAY(PixelRun) runs;       // of all pixels with pairs
} ThinSearch;

static uint64_t most_pairs(const ThinParts *parts)
{
    const uint64_t most = (uint64_t)PAIRS_OF_PIXEL * parts->width * parts->height;
    return most > PAIRS_MOST ? most : PAIRS_MOST;
}

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

// Records the pixels whose centers lie in the triangles.
static void cover_pixels(void *context, uint32_t first, uint32_t end)
{
    const ThinSearch *search = context;
    const CellGrid grid = pixels_of(search);
    for (uint32_t i = first; i < end; i++) {
        Outline outline;
        if (!projection_outline(&search->projection, triangle_at(search, i), &outline))
            continue;
        const CellRange rows = cells_sampled(outline.box.low[1], outline.box.high[1], &grid, 1);
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
// square that contains or touches the pixel. On each axis, squares that contain the pixel are
// tested first.
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

// If the triangle is thin, lists the pixels that it touches and at which the piece is not wide. If
// no probes are needed, or if there are too many pairs, lists a pixel only once per piece.
static bool list_touched(ThinSearch *search, uint32_t triangle, TaskList *list)
{
    const CellGrid grid = pixels_of(search);
    const uint64_t most = search->source->has_probes ? most_pairs(search->parts) : 0;
    Outline outline;
    if (!projection_outline(&search->projection, triangle, &outline) ||
        !outline_is_thinner(&outline, THIN_WIDTH))
        return true;
    const CellRange rows = cells_touched(outline.box.low[1], outline.box.high[1], &grid, 1);
    for (uint32_t row = rows.first; row < rows.end; row++) {
        const CellRange columns = outline_touched(&outline, &grid, row);
        for (uint32_t column = columns.first; column < columns.end; column++) {
            const PixelTriangle pair = {row * grid.counts[0] + column, triangle};
            if (is_wide(search, column, row))
                continue;
            const bool is_first =
                search->touched[pair.pixel] != search->number &&
                atomic_exchange(&search->touched[pair.pixel], search->number) != search->number;
            if ((search->met++ < most || is_first) && !array_push(&list->pairs, pair, &list->error))
                return false;
        }
    }
    return true;
}

static void list_all_touched(void *context, uint32_t first, uint32_t end)
{
    ThinSearch *search = context;
    TaskList *list = &search->lists[first / TRIANGLES_OF_TASK];
    for (uint32_t i = first; i < end; i++)
        if (!list_touched(search, triangle_at(search, i), list))
            return;
}

static bool append_list(ThinSearch *search, const TaskList *list, Error *error)
{
    if (list->error.text[0] != '\0')
        return error_set(error, "%s", list->error.text);
    for (size_t i = 0; i < list->pairs.count; i++)
        if (!array_push(&search->pairs, list->pairs.data[i], error))
            return false;
    for (size_t i = 0; i < list->probes.count; i++)
        if (!thin_parts_add(search->parts, &list->probes.data[i], error))
            return false;
    return true;
}

// Runs `work` for tasks of `part` elements, and collects the pairs and probes that it lists.
static bool collect(ThinSearch *search, uint32_t count, uint32_t part, ThreadPoolPart *work,
                    Error *error)
{
    const uint32_t tasks = range_count(count, part);
    search->lists = memory_zeroed(tasks, sizeof *search->lists, error);
    bool ok = search->lists != NULL;
    if (ok)
        thread_pool_share(search->source->pool, count, part, work, search);
    for (uint32_t task = 0; search->lists != NULL && task < tasks; task++) {
        ok = ok && append_list(search, &search->lists[task], error);
        free(search->lists[task].pairs.data);
        free(search->lists[task].probes.data);
    }
    free(search->lists);
    return ok;
}

static int compare_pixels(const void *a, const void *b)
{
    const uint32_t one = ((const PixelTriangle *)a)->pixel;
    const uint32_t other = ((const PixelTriangle *)b)->pixel;
    return (one > other) - (one < other);
}

// Sorts the pairs into runs of one pixel each.
static bool find_runs(ThinSearch *search, Error *error)
{
    const PixelTriangle *pairs = search->pairs.data;
    const uint32_t count = (uint32_t)search->pairs.count;
    search->runs.count = 0;
    if (count > 0)
        qsort(search->pairs.data, count, sizeof *search->pairs.data, compare_pixels);
    for (uint32_t i = 0; i < count;) {
        PixelRun run = {.first = i, .end = i};
        while (run.end < count && pairs[run.end].pixel == pairs[i].pixel)
            run.end++;
        if (!array_push(&search->runs, run, error))
            return false;
        i = run.end;
    }
    return true;
}

// Returns the axis of lines that the pixel's triangles cross. If an earlier part has chosen an axis
// for the pixel, returns this axis.
static ThinAxis axis_of(const ThinSearch *search, const PixelRun *run)
{
    const uint32_t pixel = search->pairs.data[run->first].pixel;
    double height = 0, width = 0;
    if (search->parts->axes[pixel] != THIN_NONE)
        return (ThinAxis)search->parts->axes[pixel];
    for (uint32_t i = run->first; i < run->end; i++) {
        Outline outline;
        if (!projection_outline(&search->projection, search->pairs.data[i].triangle, &outline))
            continue;
        width += outline.box.high[0] - outline.box.low[0];
        height += outline.box.high[1] - outline.box.low[1];
    }
    return height >= width ? THIN_ROWS : THIN_COLUMNS;
}

static void exchange_axes(Outline *outline)
{
    for (uint32_t i = 0; i < outline->count; i++) {
        const double x = outline->corners[i][0];
        outline->corners[i][0] = outline->corners[i][1];
        outline->corners[i][1] = x;
    }
    outline_complete(outline);
}

// Draws the pixel's triangles: the places whose middles they contain become PLACE_DRAWN.
static void draw_triangles(const ThinSearch *search, const PixelRun *run, CellGrid grid,
                           ThinDrawing drawing)
{
    if (run->axis == THIN_COLUMNS) {
        const double x = grid.origin[0];
        grid.origin[0] = grid.origin[1];
        grid.origin[1] = x;
    }
    for (uint32_t i = run->first; i < run->end; i++) {
        Outline outline;
        if (!projection_outline(&search->projection, search->pairs.data[i].triangle, &outline))
            continue;
        if (run->axis == THIN_COLUMNS)
            exchange_axes(&outline);
        const CellRange lines = cells_sampled(outline.box.low[1], outline.box.high[1], &grid, 1);
        for (uint32_t line = lines.first; line < lines.end; line++) {
            const CellRange places = outline_sampled(&outline, &grid, line);
            for (uint32_t place = places.first; place < places.end; place++)
                drawing[line][place] = PLACE_DRAWN;
        }
    }
}

// Adds the probes of the pixels of search->runs from `first` to `end` - 1.
static void probe_pixels(void *context, uint32_t first, uint32_t end)
{
    ThinSearch *search = context;
    TaskList *list = &search->lists[first / RUNS_OF_TASK];
    const uint32_t width = search->parts->width;
    for (; first < end; first++) {
        PixelRun *run = &search->runs.data[first];
        const uint32_t pixel = search->pairs.data[run->first].pixel;
        const CellGrid grid = {
            1,
            1,
            {REFINE_GRID, REFINE_GRID},
            {(double)(pixel % width) * REFINE_GRID, (double)(pixel / width) * REFINE_GRID}};
        ThinDrawing drawing = {{PLACE_EMPTY}};
        run->axis = axis_of(search, run);
        draw_triangles(search, run, grid, drawing);
        if (!thin_drawing_probe(drawing, pixel, search->levels, &list->probes, &list->error))
            return;
    }
}

static bool search_piece(ThinSearch *search, uint32_t end, Error *error)
{
    ThinParts *parts = search->parts;
    search->count = end - search->first;
    search->number++;
    search->met = 0;
    search->pairs.count = 0;
    search->runs.count = 0;
    search->levels = thin_parts_affordable(parts);
    thread_pool_share(search->source->pool, search->count, TRIANGLES_OF_TASK, cover_pixels, search);
    bool ok = collect(search, search->count, TRIANGLES_OF_TASK, list_all_touched, error);
    if (ok && search->source->has_probes && search->met <= most_pairs(parts))
        ok = find_runs(search, error) &&
             collect(search, (uint32_t)search->runs.count, RUNS_OF_TASK, probe_pixels, error);
    for (size_t i = 0; ok && i < search->runs.count; i++)
        thin_parts_touch(parts, search->pairs.data[search->runs.data[i].first].pixel,
                         search->runs.data[i].axis);
    for (size_t i = 0; ok && i < search->pairs.count; i++)
        thin_parts_touch(parts, search->pairs.data[i].pixel, THIN_ROWS);
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
    free(search->projection.points);
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
