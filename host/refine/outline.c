// SPDX-License-Identifier: MIT
// The part of a convex polygon between two horizontal lines is convex. In each row, the polygon
// therefore touches consecutive cells, from its smallest to its largest x between the row's edges.
#include "refine/outline.h"

#include <math.h>

double outline_signed_area(const Outline *outline)
{
    double area = 0;
    const double *origin = outline->corners[0];
    for (uint32_t i = 2; i < outline->count; i++) {
        const double *one = outline->corners[i - 1], *other = outline->corners[i];
        area += (one[0] - origin[0]) * (other[1] - origin[1]) -
                (other[0] - origin[0]) * (one[1] - origin[1]);
    }
    return area;
}

static double smaller(double a, double b)
{
    return a < b ? a : b;
}

static double larger(double a, double b)
{
    return a > b ? a : b;
}

void outline_complete(Outline *outline)
{
    const double *first = outline->corners[0];
    for (int axis = 0; axis < 2; axis++)
        outline->box.low[axis] = outline->box.high[axis] = first[axis];
    for (uint32_t i = 0; i < outline->count; i++) {
        const double *from = outline->corners[i];
        const double *to = i + 1 < outline->count ? outline->corners[i + 1] : first;
        outline->slopes[i] = (to[0] - from[0]) / (to[1] - from[1]);
        for (int axis = 0; axis < 2; axis++) {
            outline->box.low[axis] = smaller(outline->box.low[axis], from[axis]);
            outline->box.high[axis] = larger(outline->box.high[axis], from[axis]);
        }
    }
}

static double perimeter_of(const Outline *outline)
{
    double perimeter = 0;
    const double *from = outline->corners[outline->count - 1];
    for (uint32_t i = 0; i < outline->count; i++) {
        const double *to = outline->corners[i];
        const double x = to[0] - from[0], y = to[1] - from[1];
        perimeter += sqrt(x * x + y * y);
        from = to;
    }
    return perimeter;
}

// The area of a triangle is half its perimeter times its inradius. The area of any other convex
// polygon is between this product and twice this product.
bool outline_is_thinner(const Outline *outline, double diameter)
{
    if (outline->box.high[0] - outline->box.low[0] < diameter ||
        outline->box.high[1] - outline->box.low[1] < diameter)
        return true;
    const double area = fabs(outline_signed_area(outline)) / 2;
    return (outline->count == 3 ? 4 : 2) * area < diameter * perimeter_of(outline);
}

// Computes the smallest and the largest x of the polygon where y is in [low, high]. Returns false
// if the polygon has no point there.
static bool find_extent(const Outline *outline, double low, double high, double extent[2])
{
    extent[0] = INFINITY;
    extent[1] = -INFINITY;
    for (uint32_t i = 0; i < outline->count; i++) {
        const double *one = outline->corners[i];
        const double *other = outline->corners[i + 1 < outline->count ? i + 1 : 0];
        const double *from = one[1] < other[1] ? one : other;
        const double *to = one[1] < other[1] ? other : one;
        if (to[1] < low || from[1] > high)
            continue;
        const double start =
            from[1] < low ? from[0] + (low - from[1]) * outline->slopes[i] : from[0];
        const double end = to[1] > high ? from[0] + (high - from[1]) * outline->slopes[i] : to[0];
        extent[0] = smaller(extent[0], smaller(start, end));
        extent[1] = larger(extent[1], larger(start, end));
    }
    return extent[0] <= extent[1];
}

CellRange outline_near(const Outline *outline, const CellGrid *grid, uint32_t row, double reach)
{
    double extent[2] = {outline->box.low[0], outline->box.high[0]};
    const double top = grid->origin[1] + row * grid->side - reach;
    const double bottom = top + grid->side + 2 * reach;
    const bool is_all = outline->box.low[1] >= top && outline->box.high[1] <= bottom;
    if (!is_all && !find_extent(outline, top, bottom, extent))
        return (CellRange){0, 0};
    return cells_touched(extent[0] - reach, extent[1] + reach, grid, 0);
}

CellRange outline_touched(const Outline *outline, const CellGrid *grid, uint32_t row)
{
    return outline_near(outline, grid, row, 0);
}

CellRange outline_sampled(const Outline *outline, const CellGrid *grid, uint32_t row)
{
    double extent[2];
    const double middle = grid->origin[1] + (row + 0.5) * grid->side;
    if (!find_extent(outline, middle, middle, extent))
        return (CellRange){0, 0};
    return cells_sampled(extent[0], extent[1], grid, 0);
}
