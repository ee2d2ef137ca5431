// SPDX-License-Identifier: MIT
// A disk contains the center of a cell if its diameter is at least the cells' diagonal. At the last
// level, this diagonal is a 57th of a pixel. Smaller spheres may be missed.
#include "refine/thin_parts.h"

#include "base/vec.h"

#include <math.h>
#include <stdlib.h>

#define HALF_DIAGONAL 0.70710678

// Projects a sphere. Returns false if it is behind the eye or as large as a pixel.
static bool project(const FrameData *frame, const SphereData *sphere, Footprint *footprint)
{
    const CameraData *camera = &frame->camera;
    const Vec3 right = vec3_of_floats(camera->right_step), down = vec3_of_floats(camera->down_step);
    const Vec3 seen = vec3_sub(vec3_of_floats(sphere->center), vec3_of_floats(camera->eye));
    const double depth = vec3_dot(seen, vec3_of_floats(camera->forward));
    const double step = sqrt(vec3_dot(right, right));
    if (depth <= sphere->radius)
        return false;
    const double x = vec3_dot(seen, right) / (depth * step * step);
    const double y = vec3_dot(seen, down) / (depth * step * step);
    const double radius = sphere->radius / (depth * step) / 2;
    if (radius > HALF_DIAGONAL * REFINE_GRID)
        return false;
    footprint->x = (float)((x + (double)frame->width * REFINE_GRID - 1) / 2);
    footprint->y = (float)((y + (double)frame->height * REFINE_GRID - 1) / 2);
    footprint->inner = (float)radius;
    footprint->outer = (float)(radius * sqrt(1 + (x * x + y * y) * step * step) * 1.001);
    return true;
}

// Computes the range of pixels along an axis that the disk touches, clipped to the picture.
static bool reach(float middle, float radius, uint32_t pixels, uint32_t range[2])
{
    const double low = floor((middle - radius + 0.5) / REFINE_GRID);
    const double high = floor((middle + radius + 0.5) / REFINE_GRID);
    if (!(high >= 0 && low < pixels))
        return false;
    range[0] = low > 0 ? (uint32_t)low : 0;
    range[1] = high < pixels - 1 ? (uint32_t)high : pixels - 1;
    return true;
}

static bool add_sphere(Footprints *footprints, const FrameData *frame, const SphereData *sphere,
                       Error *error)
{
    Footprint footprint;
    uint32_t columns[2], rows[2];
    if (!project(frame, sphere, &footprint) ||
        !reach(footprint.x, footprint.outer, frame->width, columns) ||
        !reach(footprint.y, footprint.outer, frame->height, rows))
        return true;
    for (uint32_t y = rows[0]; y <= rows[1]; y++)
        for (uint32_t x = columns[0]; x <= columns[1]; x++) {
            footprint.pixel = y * frame->width + x;
            if (!array_push(&footprints->list, footprint, error))
                return false;
        }
    return true;
}

static int compare(const void *a, const void *b)
{
    const uint32_t first = ((const Footprint *)a)->pixel, second = ((const Footprint *)b)->pixel;
    return (first > second) - (first < second);
}

bool footprints_make(Footprints *footprints, const FrameData *frame, const SphereData *spheres,
                     Error *error)
{
    *footprints = (Footprints){.width = frame->width};
    for (uint32_t i = 0; i < frame->sphere_count; i++)
        if (!add_sphere(footprints, frame, &spheres[i], error)) {
            footprints_free(footprints);
            return false;
        }
    if (footprints->list.count > 0)
        qsort(footprints->list.data, footprints->list.count, sizeof *footprints->list.data,
              compare);
    return true;
}

void footprints_free(Footprints *footprints)
{
    free(footprints->list.data);
    *footprints = (Footprints){0};
}

// Returns whether the cell with that center and side must be subdivided to hit the sphere.
static bool cuts(const Footprint *footprint, const uint32_t middle[2], uint32_t side)
{
    const double reach = side / 2.0 + footprint->outer;
    return footprint->inner < HALF_DIAGONAL * side &&
           fabs((double)footprint->x - middle[0]) <= reach &&
           fabs((double)footprint->y - middle[1]) <= reach;
}

// Returns the first footprint of the pixel or of a later one.
static const Footprint *first_of(const Footprints *footprints, uint32_t pixel)
{
    size_t low = 0, high = footprints->list.count;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (footprints->list.data[middle].pixel < pixel)
            low = middle + 1;
        else
            high = middle;
    }
    return footprints->list.data + low;
}

unsigned footprints_marks(const Footprints *footprints, const CellGroup *group)
{
    const uint32_t side = refine_tree_cell_side(group->level);
    const uint32_t pixel = group->y / REFINE_GRID * footprints->width + group->x / REFINE_GRID;
    const Footprint *end = first_of(footprints, pixel + 1);
    unsigned marks = 0;
    for (const Footprint *footprint = first_of(footprints, pixel); footprint < end; footprint++)
        for (uint32_t cell = 0; cell < GROUP_CELLS; cell++) {
            uint32_t middle[2];
            refine_tree_cell_place(group, cell, middle);
            if (group->groups[cell] == 0 && cuts(footprint, middle, side))
                marks |= 1u << cell;
        }
    return marks;
}
