// SPDX-License-Identifier: MIT
// Samples a field block by block, and skips blocks that the surface cannot reach. Then makes the
// inside well-composed (Latecki, Eckhardt, Rosenfeld, "Well-Composed Sets", CVIU 1995). In a
// well-composed set, no two inside or outside samples touch only across the diagonal of a square or
// cube. The set's border is a 2-manifold, so surface nets are closed, and two triangles meet at
// each edge.
#include "grid.h"

#include "base/array.h"

#include <assert.h>
#include <stdlib.h>

#define BLOCK_SAMPLES 4

// Fields only approximate distances. If the magnitude of the field at a block's center exceeds
// BLOCK_CAUTION times the distance from the center to the block's corners, the surface does not
// cross the block, and all samples of the block get the center's value.
#define BLOCK_CAUTION 2.0

// The depth of a sample that is moved inside, in cells. The depth is small, so that the surface
// hardly moves.
#define REPAIR_DEPTH 0.05F

static int smaller_count(int a, int b)
{
    return a < b ? a : b;
}

// Higher cells are smaller, so the height is the integral of the cell sizes. x and y shrink at the
// same rate, so that cells remain nearly cubes.
Vec3 grid_point(const Grid *grid, Vec3 at)
{
    const Vec3 straight = vec3_add(grid->low, vec3_scale(at, grid->cell));
    const double size = 1 - grid->taper * straight.z;
    return vec3(straight.x * size, straight.y * size, 0.5 * straight.z * (1 + size));
}

// Solves the height of grid_point, z = (1 - size * size) / (2 * taper), for the size.
double grid_cell_size(const Model *model, Vec3 point)
{
    return model->cell * sqrt(1 - 2 * model->taper * point.z);
}

static void sample_block(Grid *grid, Field *field, const int first[3])
{
    const double half = 0.5 * BLOCK_SAMPLES;
    const double middle =
        field(grid_point(grid, vec3(first[0] + half, first[1] + half, first[2] + half)));
    const bool far = fabs(middle) > BLOCK_CAUTION * half * sqrt(3.0) * grid->cell;
    int end[3];
    for (int axis = 0; axis < 3; axis++)
        end[axis] = smaller_count(first[axis] + BLOCK_SAMPLES, grid->size[axis]);
    for (int z = first[2]; z < end[2]; z++)
        for (int y = first[1]; y < end[1]; y++)
            for (int x = first[0]; x < end[0]; x++)
                grid->values[grid_sample(grid, x, y, z)] =
                    (float)(far ? middle : field(grid_point(grid, vec3(x, y, z))));
}

static void sample_all(Grid *grid, Field *field)
{
    for (int z = 0; z < grid->size[2]; z += BLOCK_SAMPLES)
        for (int y = 0; y < grid->size[1]; y += BLOCK_SAMPLES)
            for (int x = 0; x < grid->size[0]; x += BLOCK_SAMPLES)
                sample_block(grid, field, (const int[3]){x, y, z});
}

size_t grid_cell_end(const Grid *grid)
{
    return grid_sample_count(grid) - grid_sample(grid, 1, 1, 1);
}

static size_t cell_corner(const Grid *grid, size_t cell, unsigned corner)
{
    return cell + grid_sample(grid, corner & 1, corner >> 1 & 1, (int)(corner >> 2));
}

unsigned grid_cell_mask(const Grid *grid, size_t cell)
{
    unsigned mask = 0;
    for (unsigned corner = 0; corner < 8; corner++)
        mask |= (unsigned)(grid->values[cell_corner(grid, cell, corner)] < 0) << corner;
    return mask;
}

static bool touches_across_a_square(unsigned mask)
{
    for (unsigned axis = 1; axis < 8; axis *= 2) {
        const unsigned u = axis == 1 ? 2 : 1, v = axis == 4 ? 2 : 4;
        for (unsigned side = 0; side <= axis; side += axis) {
            const unsigned a = mask >> side & 1, b = mask >> (side | u) & 1;
            const unsigned c = mask >> (side | v) & 1, d = mask >> (side | u | v) & 1;
            if (a == d && b == c && a != b)
                return true;
        }
    }
    return false;
}

static bool touches_across_the_cube(unsigned mask)
{
    for (unsigned corner = 0; corner < 4; corner++) {
        const unsigned pair = 1U << corner | 1U << (7 - corner);
        if (mask == pair || mask == (0xFFU ^ pair))
            return true;
    }
    return false;
}

// Turns one outside corner of the cell into an inside corner: the one nearest to the surface.
static void repair_cell(Grid *grid, size_t cell)
{
    float *nearest = NULL;
    for (unsigned corner = 0; corner < 8; corner++) {
        float *value = &grid->values[cell_corner(grid, cell, corner)];
        if (*value >= 0 && (nearest == NULL || *value < *nearest))
            nearest = value;
    }
    assert(nearest != NULL);
    *nearest = -REPAIR_DEPTH * (float)grid->cell;
}

// Returns whether a sample has changed. A repair only moves samples from outside to inside, so
// repeated calls terminate.
static bool repair_all(Grid *grid, const bool critical[256])
{
    bool changed = false;
    const size_t end = grid_cell_end(grid);
    for (size_t cell = 0; cell < end; cell++)
        while (critical[grid_cell_mask(grid, cell)]) {
            repair_cell(grid, cell);
            changed = true;
        }
    return changed;
}

static void make_well_composed(Grid *grid)
{
    bool critical[256];
    for (unsigned mask = 0; mask < 256; mask++)
        critical[mask] = touches_across_a_square(mask) || touches_across_the_cube(mask);
    while (repair_all(grid, critical))
        ;
}

// Returns whether all samples of a row along x that lie on the grid's faces are outside.
static bool row_ends_outside(const Grid *grid, int y, int z)
{
    const bool on_face = y == 0 || z == 0 || y + 1 == grid->size[1] || z + 1 == grid->size[2];
    const int step = on_face ? 1 : grid->size[0] - 1;
    for (int x = 0; x < grid->size[0]; x += step)
        if (grid->values[grid_sample(grid, x, y, z)] < 0)
            return false;
    return true;
}

static bool faces_are_outside(const Grid *grid)
{
    for (int z = 0; z < grid->size[2]; z++)
        for (int y = 0; y < grid->size[1]; y++)
            if (!row_ends_outside(grid, y, z))
                return false;
    return true;
}

bool grid_make(Grid *grid, const Model *model, Error *error)
{
    const Vec3 extent = vec3_sub(model->high, model->low);
    const double lengths[3] = {extent.x, extent.y, extent.z};
    *grid = (Grid){.low = model->low, .cell = model->cell, .taper = model->taper};
    for (int axis = 0; axis < 3; axis++)
        grid->size[axis] = (int)(lengths[axis] / model->cell) + 2;
    grid->values = memory_raw(grid_sample_count(grid), sizeof *grid->values, error);
    if (grid->values == NULL)
        return false;
    sample_all(grid, model->field);
    make_well_composed(grid);
    if (!faces_are_outside(grid))
        return error_set(error, "the model %s reaches out of its box", model->name);
    return true;
}

void grid_free(Grid *grid)
{
    free(grid->values);
    *grid = (Grid){0};
}
