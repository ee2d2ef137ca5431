// SPDX-License-Identifier: MIT
// Finds the cells around thin spheres, and adds the cells that thin_triangles.c finds.
#include "refine/thin_parts.h"

#include "refine/thin_cells.h"
#include "refine/thin_triangles.h"
#include "scene/camera.h"

#include <math.h>
#include <stdlib.h>

// A disk contains the center of a cell if its diameter is at least the cells' diagonal. At the last
// level, this diagonal is a 57th of a pixel. Samples may miss smaller spheres.

#define HALF_DIAGONAL 0.70710678

// A sphere's projection, in cells of the last level.
typedef struct {
    OutlineBox box;  // around the outline
    double diameter; // of a disk inside the outline
} SphereOutline;

// Projects a sphere. Returns false unless the whole sphere is in front of the eye.
static bool project(const FrameData *frame, const SphereData *sphere, SphereOutline *outline)
{
    const CameraData *camera = &frame->camera;
    const Vec3 right = vec3_of_floats(camera->right_step), down = vec3_of_floats(camera->down_step);
    const Vec3 seen = vec3_sub(vec3_of_floats(sphere->center), vec3_of_floats(camera->eye));
    const double depth = vec3_dot(seen, vec3_of_floats(camera->forward));
    const double step = sqrt(vec3_dot(right, right));
    if (depth <= sphere->radius)
        return false;
    const double reduction = camera_reduction(camera, depth);
    const double x = vec3_dot(seen, right) / (reduction * step * step);
    const double y = vec3_dot(seen, down) / (reduction * step * step);
    const double radius = sphere->radius / (reduction * step) / 2;
    const double tangent = camera->orthographic != 0 ? 0 : sqrt(x * x + y * y) * step;
    const double outer = radius * sqrt(1 + tangent * tangent) * 1.001;
    const double middle[2] = {(x + (double)frame->width * REFINE_GRID) / 2,
                              (y + (double)frame->height * REFINE_GRID) / 2};
    for (int axis = 0; axis < 2; axis++) {
        outline->box.low[axis] = middle[axis] - outer;
        outline->box.high[axis] = middle[axis] + outer;
    }
    outline->diameter = 2 * radius;
    return true;
}

// Returns the columns or rows of pixels that the outline's box touches.
static CellRange pixels_along(const FrameData *frame, const SphereOutline *outline, int axis)
{
    const CellGrid pixels = {REFINE_GRID, 1.0 / REFINE_GRID, {frame->width, frame->height}, {0, 0}};
    const double most = (double)(pixels.counts[axis] + 1) * REFINE_GRID;
    return cells_touched(fmax(-1, fmin(most, outline->box.low[axis])),
                         fmax(-1, fmin(most, outline->box.high[axis])), &pixels, axis);
}

// Adds the pixel's cells of a level that the outline's box touches.
static void add_cells(ThinParts *parts, const SphereOutline *outline, uint32_t pixel,
                      uint32_t level)
{
    const CellGrid cells = thin_parts_grid(parts, pixel, level, 0);
    const CellRange rows = box_touched(&outline->box, &cells, 1);
    const CellRange columns = box_touched(&outline->box, &cells, 0);
    uint32_t *masks = thin_parts_rows(parts, pixel, level);
    for (uint32_t row = rows.first; row < rows.end; row++)
        parts->cuts[level] +=
            thin_row_add(&masks[row], (1u << columns.end) - (1u << columns.first));
}

static bool is_thin(const SphereOutline *outline, uint32_t level)
{
    return outline->diameter < 2 * HALF_DIAGONAL * refine_tree_cell_side(level);
}

// If `level` is negative, gives slots to the pixels that a thin sphere touches. Otherwise, adds the
// sphere's cells of this level.
static void visit_sphere(ThinParts *parts, const FrameData *frame, const SphereData *sphere,
                         int level)
{
    SphereOutline outline;
    if (!project(frame, sphere, &outline) || !is_thin(&outline, level < 0 ? 0 : (uint32_t)level))
        return;
    const CellRange columns = pixels_along(frame, &outline, 0);
    const CellRange rows = pixels_along(frame, &outline, 1);
    for (uint32_t y = rows.first; y < rows.end; y++)
        for (uint32_t x = columns.first; x < columns.end; x++) {
            const uint32_t pixel = y * parts->width + x;
            if (level < 0)
                thin_parts_add_pixel(parts, pixel);
            else
                add_cells(parts, &outline, pixel, (uint32_t)level);
        }
}

// Adds the cells around spheres with a diameter below the cells' diagonal.
static bool thin_spheres_find(ThinParts *parts, const ThinSource *source, Error *error)
{
    const FrameData *frame = source->frame;
    for (uint32_t i = 0; i < frame->sphere_count; i++)
        visit_sphere(parts, frame, &source->spheres[i], -1);
    for (uint32_t level = 0; level < thin_parts_affordable(parts); level++) {
        if (!thin_parts_make_room(parts, level, error))
            return false;
        for (uint32_t i = 0; i < frame->sphere_count; i++)
            visit_sphere(parts, frame, &source->spheres[i], (int)level);
    }
    return true;
}

// Makes room for all slots at the levels that the sample budget covers.
static bool complete_room(ThinParts *parts, Error *error)
{
    parts->levels = parts->cuts[0] > 0 ? thin_parts_affordable(parts) : 0;
    for (uint32_t level = 0; level < parts->levels; level++)
        if (!thin_parts_make_room(parts, level, error))
            return false;
    return true;
}

bool thin_parts_make(ThinParts *parts, const ThinSource *source, Error *error)
{
    const FrameData *frame = source->frame;
    const size_t pixels = (size_t)frame->width * frame->height;
    *parts = (ThinParts){.width = frame->width, .height = frame->height, .most = source->levels};
    parts->slots = memory_zeroed(pixels, sizeof *parts->slots, error);
    bool ok = parts->slots != NULL;
    // With max_level 0, camera rays see only the background.
    if (ok && frame->max_level > 0)
        ok = thin_spheres_find(parts, source, error) && thin_triangles_find(parts, source, error);
    ok = ok && complete_room(parts, error);
    if (!ok)
        thin_parts_free(parts);
    return ok;
}

void thin_parts_free(ThinParts *parts)
{
    for (uint32_t level = 0; level < REFINE_LEVELS; level++)
        free(parts->rows[level].data);
    free(parts->slots);
    *parts = (ThinParts){0};
}
