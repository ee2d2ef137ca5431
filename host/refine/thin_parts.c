// SPDX-License-Identifier: MIT
// Searches piece by piece and level by level. Threads first find all cells whose samples the piece
// contains. They then examine the cells that each thin triangle touches. The results are sets,
// which do not depend on the order of work.
#include "refine/thin_parts.h"

#include "refine/outline.h"

#include <stdlib.h>

#define DIAGONAL 1.41421356 // of a cell, relative to its side

#define TRIANGLES_OF_TASK 1024

typedef struct {
    ThinParts *parts;
    const ThinSource *source;
    Projection projection;          // of the mesh
    MeshPieces pieces;              // of the mesh
    uint32_t first, count;          // the piece's triangles, in the order of the pieces
    uint8_t *depths;                // in that order: the number of levels to search
    CellSet covered[REFINE_LEVELS]; // cells whose samples the piece contains
    CellSet wide;                   // pixels at which the piece is wide
    _Atomic uint32_t top, bottom;   // the piece covers rows of pixels top to bottom - 1
    uint32_t level;                 // the level that is being searched
    _Atomic bool found;             // a triangle remains to be searched
    _Atomic uint64_t cuts[REFINE_LEVELS];
} Search;

static CellGrid grid_of(const Search *search, uint32_t level)
{
    const FrameData *frame = search->source->frame;
    const uint32_t scale = search->parts->cut[level].scale, side = refine_tree_cell_side(level);
    return (CellGrid){side, 1.0 / side, {frame->width * scale, frame->height * scale}};
}

static uint32_t triangle_at(const Search *search, uint32_t place)
{
    const uint32_t *order = search->pieces.order;
    return order == NULL ? search->first + place : order[search->first + place];
}

static uint8_t *depth_of(const Search *search, uint32_t place)
{
    return &search->depths[search->first + place];
}

// Computes the outline of a piece's triangle. Returns false if it is invisible.
static bool outline_of(const Search *search, uint32_t place, Outline *outline)
{
    return projection_outline(&search->projection, triangle_at(search, place), outline);
}

static bool is_thin(const Outline *outline, uint32_t level)
{
    return outline_is_thinner(outline, DIAGONAL * refine_tree_cell_side(level));
}

static void add_row(CellSet *covered, uint32_t row, CellRange columns)
{
    if (covered->scale == 1)
        pixel_set_add_range(covered, row, columns.first, columns.end);
    else
        for (uint32_t column = columns.first; column < columns.end; column++)
            cell_set_add(covered, column, row);
}

static void cover_cells(CellSet *covered, const Outline *outline, const CellGrid *grid)
{
    const CellRange rows = box_sampled(&outline->box, grid, 1);
    for (uint32_t row = rows.first; row < rows.end; row++) {
        const CellRange columns = outline_sampled(outline, grid, row);
        if (columns.first < columns.end)
            add_row(covered, row, columns);
    }
}

static void include_rows(Search *search, CellRange rows)
{
    uint32_t top = search->top, bottom = search->bottom;
    while (rows.first < top && !atomic_compare_exchange_weak(&search->top, &top, rows.first))
        continue;
    while (rows.end > bottom && !atomic_compare_exchange_weak(&search->bottom, &bottom, rows.end))
        continue;
}

// Adds the pixels that all triangles cover. Only thin triangles are searched.
static void cover_pixels_of_piece(void *context, uint32_t first, uint32_t end)
{
    Search *search = context;
    const CellGrid grid = grid_of(search, 0);
    CellRange all = {UINT32_MAX, 0};
    bool found = false;
    for (uint32_t i = first; i < end; i++) {
        Outline outline;
        *depth_of(search, i) = 0;
        if (!outline_of(search, i, &outline))
            continue;
        const CellRange rows = box_touched(&outline.box, &grid, 1);
        all.first = rows.first < all.first ? rows.first : all.first;
        all.end = rows.end > all.end ? rows.end : all.end;
        cover_cells(&search->covered[0], &outline, &grid);
        *depth_of(search, i) = is_thin(&outline, 0);
        found |= *depth_of(search, i) > 0;
    }
    include_rows(search, all);
    if (found)
        search->found = true;
}

static void cover_cells_of_piece(void *context, uint32_t first, uint32_t end)
{
    Search *search = context;
    const uint32_t level = search->level;
    const CellGrid grid = grid_of(search, level);
    for (uint32_t i = first; i < end; i++) {
        Outline outline;
        if (*depth_of(search, i) > level && outline_of(search, i, &outline))
            cover_cells(&search->covered[level], &outline, &grid);
    }
}

static bool holds_block(const CellSet *covered, uint32_t column, uint32_t row)
{
    return cell_set_has(covered, column, row) && cell_set_has(covered, column + 1, row) &&
           cell_set_has(covered, column, row + 1) && cell_set_has(covered, column + 1, row + 1);
}

// Returns whether the piece is wide at a cell. Tests the nearest corners first.
static bool is_wide(const Search *search, uint32_t column, uint32_t row)
{
    static const int steps[4] = {-1, 0, -2, 1};
    for (int i = 0; i < 16; i++)
        if (holds_block(&search->covered[search->level], column + (uint32_t)steps[i % 4],
                        row + (uint32_t)steps[i / 4]))
            return true;
    return false;
}

static bool is_large(const Search *search)
{
    return search->count > 4 * TRIANGLES_OF_TASK;
}

static void find_wide_pixels(void *context, uint32_t first, uint32_t end)
{
    Search *search = context;
    for (uint32_t row = first; row < end; row++)
        pixel_set_widen_row(&search->wide, &search->covered[0], search->top + row);
}

// Returns whether the piece is wide at all pixels of the box around a triangle. This test is fast,
// and true for most triangles of large pieces.
static bool is_surely_wide(const Search *search, uint32_t place, const CellGrid *grid)
{
    OutlineBox box;
    if (search->level > 0 || !is_large(search) ||
        !projection_box(&search->projection, triangle_at(search, place), &box))
        return false;
    const CellRange columns = box_touched(&box, grid, 0), rows = box_touched(&box, grid, 1);
    for (uint32_t row = rows.first; row < rows.end; row++)
        if (!pixel_set_has_all(&search->wide, row, columns.first, columns.end))
            return false;
    return true;
}

// Returns whether the cell is subdivided for a triangle that touches it.
static bool cut_cell(Search *search, uint32_t column, uint32_t row)
{
    const uint32_t level = search->level;
    ThinParts *parts = search->parts;
    if (level > 0 && !cell_set_has(&parts->cut[level - 1], column / GROUP_SIDE, row / GROUP_SIDE))
        return false;
    if (cell_set_has(&parts->cut[level], column, row))
        return true;
    if (is_wide(search, column, row))
        return false;
    if (cell_set_add(&parts->cut[level], column, row)) {
        search->cuts[level]++;
        if (level == 0)
            slots_add(&parts->slots, column, row);
    }
    return true;
}

static bool cut_for_triangle(Search *search, const Outline *outline, const CellGrid *grid)
{
    bool found = false;
    const CellRange rows = box_touched(&outline->box, grid, 1);
    for (uint32_t row = rows.first; row < rows.end; row++) {
        const CellRange columns = outline_touched(outline, grid, row);
        for (uint32_t column = columns.first; column < columns.end; column++)
            found |= cut_cell(search, column, row);
    }
    return found;
}

static void cut_cells_of_piece(void *context, uint32_t first, uint32_t end)
{
    Search *search = context;
    const uint32_t level = search->level;
    const CellGrid grid = grid_of(search, level);
    for (uint32_t i = first; i < end; i++) {
        Outline outline;
        if (*depth_of(search, i) > level && !is_surely_wide(search, i, &grid) &&
            outline_of(search, i, &outline) && is_thin(&outline, level) &&
            cut_for_triangle(search, &outline, &grid)) {
            *depth_of(search, i) = (uint8_t)(level + 2);
            search->found = true;
        }
    }
}

// Clears the covered cells of the level, without visiting the cells of other pieces.
static void uncover_cells_of_piece(void *context, uint32_t first, uint32_t end)
{
    Search *search = context;
    const CellGrid grid = grid_of(search, 0);
    for (uint32_t i = first; i < end; i++) {
        Outline outline;
        if (*depth_of(search, i) <= search->level || !outline_of(search, i, &outline))
            continue;
        const CellRange rows = box_touched(&outline.box, &grid, 1);
        for (uint32_t row = rows.first; row < rows.end; row++) {
            const CellRange columns = outline_touched(&outline, &grid, row);
            for (uint32_t column = columns.first; column < columns.end; column++)
                cell_set_clear_pixel(&search->covered[search->level], column, row);
        }
    }
}

static void share_triangles(Search *search, ThreadPoolPart *work)
{
    thread_pool_share(search->source->pool, search->count, TRIANGLES_OF_TASK, work, search);
}

// Returns the number of levels that the sample budget covers.
static uint32_t affordable_levels(const Search *search)
{
    const FrameData *frame = search->source->frame;
    const double most = (double)THIN_SAMPLES * frame->width * frame->height;
    double samples = 0;
    uint32_t level = 0;
    while (level < REFINE_LEVELS) {
        samples += (GROUP_CELLS - 1) * (double)search->cuts[level];
        if (samples > most)
            break;
        level++;
    }
    return level;
}

static bool make_room(Search *search, uint32_t level, Error *error)
{
    return cell_set_make_room(&search->covered[level], error) &&
           cell_set_make_room(&search->parts->cut[level], error);
}

static bool search_levels(Search *search, Error *error)
{
    uint32_t *level = &search->level;
    for (*level = 0; *level < REFINE_LEVELS && search->found; ++*level) {
        if (!make_room(search, *level, error))
            return false;
        if (*level > 0)
            share_triangles(search, cover_cells_of_piece);
        search->found = false;
        share_triangles(search, cut_cells_of_piece);
        if (affordable_levels(search) <= *level)
            search->found = false;
    }
    while (*level > 1) {
        --*level;
        share_triangles(search, uncover_cells_of_piece);
    }
    return true;
}

static bool search_piece(Search *search, uint32_t end, Error *error)
{
    search->count = end - search->first;
    search->top = UINT32_MAX;
    search->bottom = 0;
    search->found = false;
    share_triangles(search, cover_pixels_of_piece);
    const uint32_t rows = search->bottom > search->top ? search->bottom - search->top : 0;
    if (search->found && is_large(search))
        thread_pool_share(search->source->pool, rows, 1, find_wide_pixels, search);
    const bool ok = search_levels(search, error);
    if (rows > 0)
        pixel_set_clear_rows(&search->covered[0], search->top, search->bottom);
    search->first = end;
    return ok;
}

static bool search_mesh(Search *search, const MeshObject *object, Error *error)
{
    const ThinSource *source = search->source;
    const Mesh *mesh = &object->mesh;
    search->pieces = (MeshPieces){0};
    search->first = 0;
    search->depths = memory_raw(mesh->triangle_count, sizeof *search->depths, error);
    bool ok = search->depths != NULL &&
              projection_begin(&search->projection, object, source->pool, error) &&
              mesh_pieces_make(&search->pieces, mesh, source->pool, error);
    for (uint32_t i = 0; ok && i < search->pieces.count; i++)
        ok = search_piece(search, search->pieces.ends[i], error);
    mesh_pieces_free(&search->pieces);
    projection_end(&search->projection);
    free(search->depths);
    return ok;
}

bool thin_parts_make(ThinParts *parts, const ThinSource *source, Error *error)
{
    Search search = {.parts = parts,
                     .source = source,
                     .projection = projection_of(source->frame, source->normalization)};
    *parts = (ThinParts){0};
    bool ok = slots_make(&parts->slots, source->frame->width, source->frame->height, error);
    for (uint32_t level = 0, scale = 1; level < REFINE_LEVELS; level++, scale *= GROUP_SIDE) {
        parts->cut[level] = cell_set_of(&parts->slots, scale);
        search.covered[level] = cell_set_of(&parts->slots, scale);
    }
    search.wide = cell_set_of(&parts->slots, 1);
    ok = ok && cell_set_make_room(&search.wide, error) && make_room(&search, 0, error);
    // With max_level 0, camera rays see only the background.
    const size_t meshes = source->frame->max_level > 0 ? source->scene->objects.count : 0;
    for (size_t i = 0; ok && i < meshes; i++)
        ok = search_mesh(&search, &source->scene->objects.data[i], error);
    for (uint32_t level = 0; level < REFINE_LEVELS; level++)
        cell_set_free(&search.covered[level]);
    cell_set_free(&search.wide);
    parts->levels = search.cuts[0] > 0 ? affordable_levels(&search) : 0;
    if (!ok)
        thin_parts_free(parts);
    return ok;
}

void thin_parts_free(ThinParts *parts)
{
    for (uint32_t level = 0; level < REFINE_LEVELS; level++)
        cell_set_free(&parts->cut[level]);
    slots_free(&parts->slots);
    *parts = (ThinParts){0};
}

unsigned thin_parts_marks(const ThinParts *parts, const CellGroup *group)
{
    unsigned marks = 0;
    for (uint32_t cell = 0; cell < GROUP_CELLS; cell++) {
        uint32_t middle[2];
        refine_tree_cell_place(group, cell, middle);
        if (group->groups[cell] == 0 && thin_parts_cut(parts, middle, group->level))
            marks |= 1u << cell;
    }
    return marks;
}
