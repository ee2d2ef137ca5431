// SPDX-License-Identifier: MIT
// Searches piece by piece, in three steps. Threads first record the pixels whose centers lie in the
// piece. They then record and list the thin triangles of each pixel at which the piece is not wide
// (thin_parts.h). Finally, they draw these triangles on the pixel's grid of places, and choose
// probes level by level.
//
// Fine meshes are wide at most pixels. The first step therefore also makes a box around each block
// of triangles, and the second step skips blocks whose boxes touch only such pixels.
//
// Invariant: all results are sets, so they do not depend on the order of work.
#include "refine/thin_places.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#define BLOCK_TRIANGLES 64
#define BLOCKS_OF_TASK  16
#define PAIRS_OF_TASK   1024

typedef struct {
    uint32_t pixel, triangle;
} PixelTriangle;

// To save memory, a piece with too many pairs of pixels and triangles has no probes. The limit is
// PAIRS_MOST, and PAIRS_OF_PIXEL more for each pixel of the picture.
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
    ThreadPool *pool;
    Projection projection;      // of the mesh
    const MeshPieces *pieces;   // of the mesh
    uint32_t first, count;      // of the piece's triangles, in the order of the pieces
    uint32_t number;            // of the piece, from 1
    uint32_t levels;            // number of levels to search for probes
    OutlineBox *boxes;          // around each block of the piece's triangles
    _Atomic uint32_t *covered;  // by pixel: the latest piece that contains the pixel's center
    uint64_t most;              // pairs that a piece may have; 0 if no probes are needed
    _Atomic uint64_t met;       // pairs of thin triangles and pixels; 0 without probes
    TaskList *lists;            // of each task
    ARRAY(PixelTriangle) pairs; // of the piece, sorted by pixel
} ThinSearch;

static uint32_t triangle_at(const ThinSearch *search, uint32_t place)
{
    const uint32_t *order = search->pieces->order;
    return order == NULL ? search->first + place : order[search->first + place];
}

// Records the pixels whose centers lie in the triangle.
static void cover_pixels(const ThinSearch *search, uint32_t triangle)
{
    const CellGrid *grid = &search->parts->pixels;
    Outline outline;
    if (!projection_outline(&search->projection, triangle, &outline))
        return;
    const CellRange rows = cells_along(&outline.box, grid, 1, CELL_CENTER);
    for (uint32_t row = rows.first; row < rows.end; row++) {
        const CellRange columns = outline_cells(&outline, grid, row, CELL_CENTER);
        for (uint32_t column = columns.first; column < columns.end; column++)
            atomic_store_explicit(&search->covered[(size_t)row * grid->counts[0] + column],
                                  search->number, memory_order_relaxed);
    }
}

// Returns the piece's triangles in a block.
static CellRange block_triangles(const ThinSearch *search, uint32_t block)
{
    const uint32_t first = block * BLOCK_TRIANGLES, left = search->count - first;
    return (CellRange){first, first + (left < BLOCK_TRIANGLES ? left : BLOCK_TRIANGLES)};
}

// Records the pixels whose centers lie in the triangles of blocks, and stores boxes around the
// blocks. Most triangles of fine meshes contain no center, and the triangles' boxes often show
// this.
static void cover_blocks(void *context, uint32_t first, uint32_t end)
{
    const ThinSearch *search = context;
    const CellGrid *grid = &search->parts->pixels;
    for (uint32_t block = first; block < end; block++) {
        const CellRange range = block_triangles(search, block);
        OutlineBox all = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}}, box;
        for (uint32_t i = range.first; i < range.end; i++) {
            const uint32_t triangle = triangle_at(search, i);
            if (!projection_box(&search->projection, triangle, &box))
                continue;
            outline_box_add(&all, &box);
            if (!range_is_empty(cells_along(&box, grid, 1, CELL_CENTER)) &&
                !range_is_empty(cells_along(&box, grid, 0, CELL_CENTER)))
                cover_pixels(search, triangle);
        }
        search->boxes[block] = all;
    }
}

// Returns a bit for each of the `count` pixels from `column` on in a row. A bit is set if the piece
// contains the pixel's center.
static inline uint32_t covered_bits(const ThinSearch *search, uint32_t column, uint32_t row,
                                    uint32_t count)
{
    const uint32_t width = search->parts->pixels.counts[0], number = search->number;
    uint32_t bits = 0;
    if (row >= search->parts->pixels.counts[1])
        return 0;
    const _Atomic uint32_t *covered = &search->covered[(size_t)row * width];
    for (uint32_t i = 0; i < count; i++)
        if (column + i < width &&
            atomic_load_explicit(&covered[column + i], memory_order_relaxed) == number)
            bits |= 1u << i;
    return bits;
}

// Returns whether the piece is wide at a pixel. The piece is wide if four covered pixels form a
// square that contains or touches the pixel. Tests a likely square first.
static bool is_wide(const ThinSearch *search, uint32_t column, uint32_t row)
{
    if ((covered_bits(search, column - 1, row - 1, 2) & covered_bits(search, column - 1, row, 2)) ==
        3)
        return true;
    uint32_t above = covered_bits(search, column - 2, row - 2, 5);
    for (uint32_t y = row - 1; y != row + 3; y++) {
        const uint32_t bits = covered_bits(search, column - 2, y, 5), both = above & bits;
        if ((both & both >> 1) != 0)
            return true;
        above = bits;
    }
    return false;
}

// Returns whether a thin triangle that touches the pixel changes nothing: the piece is wide there,
// or the pixel is recorded already and no probes are needed.
static bool is_done(const ThinSearch *search, uint32_t column, uint32_t row)
{
    const _Atomic uint8_t *axis =
        &search->parts->axes[row * search->parts->pixels.counts[0] + column];
    return (search->most == 0 && *axis != THIN_NONE) || is_wide(search, column, row);
}

// Returns whether triangles in the box change nothing at any pixel that the box touches. Returns
// false without a test if the box touches more than BLOCK_TRIANGLES pixels.
static bool is_box_done(const ThinSearch *search, const OutlineBox *box)
{
    const CellGrid *grid = &search->parts->pixels;
    const CellRange rows = cells_along(box, grid, 1, CELL_AREA);
    const CellRange columns = cells_along(box, grid, 0, CELL_AREA);
    if (range_is_empty(rows) || range_is_empty(columns))
        return true;
    if ((uint64_t)(rows.end - rows.first) * (columns.end - columns.first) > BLOCK_TRIANGLES)
        return false;
    for (uint32_t row = rows.first; row < rows.end; row++)
        for (uint32_t column = columns.first; column < columns.end; column++)
            if (!is_done(search, column, row))
                return false;
    return true;
}

// If the triangle is thin, records the pixels that it touches and at which the piece is not wide.
// Lists these pixels if they need probes.
static bool touch_pixels(ThinSearch *search, uint32_t triangle, TaskList *list)
{
    const CellGrid *grid = &search->parts->pixels;
    Outline outline;
    if (!projection_box(&search->projection, triangle, &outline.box) ||
        is_box_done(search, &outline.box) ||
        !projection_outline(&search->projection, triangle, &outline) ||
        !outline_is_thinner(&outline, THIN_WIDTH))
        return true;
    const CellRange rows = cells_along(&outline.box, grid, 1, CELL_AREA);
    for (uint32_t row = rows.first; row < rows.end; row++) {
        const CellRange columns = outline_cells(&outline, grid, row, CELL_AREA);
        for (uint32_t column = columns.first; column < columns.end; column++) {
            const PixelTriangle pair = {row * grid->counts[0] + column, triangle};
            if (is_done(search, column, row))
                continue;
            thin_parts_touch(search->parts, pair.pixel, THIN_TOUCHED);
            if (search->most > 0 && search->met++ < search->most &&
                !array_push(&list->pairs, pair, &list->error))
                return false;
        }
    }
    return true;
}

static void touch_blocks(void *context, uint32_t first, uint32_t end)
{
    ThinSearch *search = context;
    TaskList *list = &search->lists[first / BLOCKS_OF_TASK];
    for (uint32_t block = first; block < end; block++) {
        const CellRange range = block_triangles(search, block);
        const bool is_done = is_box_done(search, &search->boxes[block]);
        for (uint32_t i = range.first; i < range.end && !is_done; i++)
            if (!touch_pixels(search, triangle_at(search, i), list))
                return;
    }
}

// Runs `work` for tasks of `part` elements, and collects the pairs and probes that it lists.
static bool collect(ThinSearch *search, uint32_t count, uint32_t part, ThreadPoolPart *work,
                    Error *error)
{
    const uint32_t tasks = range_count(count, part);
    search->lists = memory_zeroed(tasks, sizeof *search->lists, error);
    bool ok = search->lists != NULL;
    if (ok)
        thread_pool_share(search->pool, count, part, work, search);
    for (uint32_t task = 0; search->lists != NULL && task < tasks; task++) {
        TaskList *list = &search->lists[task];
        if (ok && list->error.text[0] != '\0')
            ok = error_set(error, "%s", list->error.text);
        for (size_t i = 0; ok && i < list->pairs.count; i++)
            ok = array_push(&search->pairs, list->pairs.data[i], error);
        for (size_t i = 0; ok && i < list->probes.count; i++)
            ok = array_push(&search->parts->probes, list->probes.data[i], error);
        free(list->pairs.data);
        free(list->probes.data);
    }
    free(search->lists);
    return ok;
}

// Draws the triangles of pairs of one pixel: the places whose middles they contain become
// PLACE_DRAWN. Returns the axis of lines that the triangles cross.
static ThinAxis draw_triangles(const ThinSearch *search, const PixelTriangle *pairs, uint32_t count,
                               ThinDrawing drawing)
{
    const uint32_t width = search->parts->pixels.counts[0];
    const uint32_t column = pairs->pixel % width, row = pairs->pixel / width;
    const CellGrid grid = {1,
                           1,
                           {REFINE_GRID, REFINE_GRID},
                           {(double)column * REFINE_GRID, (double)row * REFINE_GRID}};
    double sides[2] = {0};
    for (uint32_t i = 0; i < count; i++) {
        Outline outline;
        if (!projection_outline(&search->projection, pairs[i].triangle, &outline))
            continue;
        const OutlineBox *box = &outline.box;
        const CellRange lines = cells_along(box, &grid, 1, CELL_CENTER);
        for (int axis = 0; axis < 2; axis++)
            sides[axis] += box->high[axis] - box->low[axis];
        for (uint32_t line = lines.first; line < lines.end; line++) {
            const CellRange places = outline_cells(&outline, &grid, line, CELL_CENTER);
            if (places.first < places.end)
                memset(&drawing[line][places.first], PLACE_DRAWN, places.end - places.first);
        }
    }
    return sides[1] >= sides[0] ? THIN_ROWS : THIN_COLUMNS;
}

static void transpose(ThinDrawing drawing)
{
    for (uint32_t line = 0; line < REFINE_GRID; line++)
        for (uint32_t place = 0; place < line; place++) {
            const uint8_t state = drawing[line][place];
            drawing[line][place] = drawing[place][line];
            drawing[place][line] = state;
        }
}

// Adds the probes of the pixels whose first pairs are the pairs from `first` to `end` - 1. A pixel
// keeps the axis that an earlier piece has chosen.
static void probe_pixels(void *context, uint32_t first, uint32_t end)
{
    ThinSearch *search = context;
    TaskList *list = &search->lists[first / PAIRS_OF_TASK];
    const PixelTriangle *pairs = search->pairs.data;
    for (uint32_t i = first; i < end; i++) {
        _Atomic uint8_t *axis = &search->parts->axes[pairs[i].pixel];
        uint32_t count = 1;
        if (i > 0 && pairs[i - 1].pixel == pairs[i].pixel)
            continue;
        while (i + count < search->pairs.count && pairs[i + count].pixel == pairs[i].pixel)
            count++;
        ThinDrawing drawing = {{PLACE_EMPTY}};
        const ThinAxis crossed = draw_triangles(search, &pairs[i], count, drawing);
        if (*axis == THIN_TOUCHED)
            *axis = (uint8_t)crossed;
        if (*axis == THIN_COLUMNS)
            transpose(drawing);
        if (!thin_drawing_probe(drawing, pairs[i].pixel, search->levels, &list->probes,
                                &list->error))
            return;
    }
}

static bool search_piece(ThinSearch *search, uint32_t end, Error *error)
{
    const uint32_t blocks = range_count(end - search->first, BLOCK_TRIANGLES);
    search->count = end - search->first;
    search->number++;
    search->met = 0;
    search->pairs.count = 0;
    search->levels = thin_parts_affordable(search->parts);
    thread_pool_share(search->pool, blocks, BLOCKS_OF_TASK, cover_blocks, search);
    bool ok = collect(search, blocks, BLOCKS_OF_TASK, touch_blocks, error);
    if (ok && search->met <= search->most && search->pairs.count > 0) {
        qsort(search->pairs.data, search->pairs.count, sizeof *search->pairs.data,
              thin_compare_pixels);
        ok = collect(search, (uint32_t)search->pairs.count, PAIRS_OF_TASK, probe_pixels, error);
    }
    search->first = end;
    return ok;
}

static bool search_mesh(ThinSearch *search, const MeshObject *object, Error *error)
{
    search->first = 0;
    const uint32_t blocks = range_count((uint32_t)object->mesh.triangle_count, BLOCK_TRIANGLES);
    bool ok = projection_begin(&search->projection, object, search->pool, error);
    search->boxes = memory_raw(blocks, sizeof *search->boxes, error);
    ok = ok && search->boxes != NULL;
    for (uint32_t i = 0; ok && i < search->pieces->count; i++)
        ok = search_piece(search, search->pieces->ends[i], error);
    free(search->projection.points);
    free(search->boxes);
    return ok;
}

bool thin_triangles_find(ThinParts *parts, const RefineSetup *setup, const FrameData *frame,
                         bool has_probes, Error *error)
{
    ThinSearch search = {.parts = parts,
                         .pool = setup->pool,
                         .projection = projection_of(frame, setup->normalization)};
    const size_t pixels = (size_t)frame->width * frame->height;
    search.most = has_probes ? PAIRS_MOST + PAIRS_OF_PIXEL * pixels : 0;
    if (setup->scene->objects.count == 0)
        return true;
    search.covered = memory_zeroed(pixels, sizeof *search.covered, error);
    bool ok = search.covered != NULL;
    for (size_t i = 0; ok && i < setup->scene->objects.count; i++) {
        search.pieces = &setup->pieces[i];
        ok = search_mesh(&search, &setup->scene->objects.data[i], error);
    }
    free(search.covered);
    free(search.pairs.data);
    return ok;
}
