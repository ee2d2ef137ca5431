// SPDX-License-Identifier: MIT
// Finds the probes of thin spheres, and adds the probes that thin_triangles.c finds.
#include "refine/thin_parts.h"

#include "refine/thin_triangles.h"
#include "scene/camera.h"

#include <math.h>
#include <stdlib.h>

// A sphere's projection, which is almost an ellipse around the projected center. A point at the
// offset (x, y) from this center is inside if form[0] x^2 + 2 form[1] x y + form[2] y^2 is at most
// the squared radius. The unit of length is a place.
typedef struct {
    OutlineBox box; // around the outline
    double middle[2];
    double radius; // the shorter radius
    double form[3];
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
    const double slant = camera->orthographic != 0 ? 0 : step;
    const double tangents[2] = {x * slant, y * slant};
    const double square = 1 + tangents[0] * tangents[0] + tangents[1] * tangents[1];
    const double outer = radius * sqrt(square) * 1.001;
    outline->middle[0] = (x + (double)frame->width * REFINE_GRID) / 2;
    outline->middle[1] = (y + (double)frame->height * REFINE_GRID) / 2;
    for (int axis = 0; axis < 2; axis++) {
        outline->box.low[axis] = outline->middle[axis] - outer;
        outline->box.high[axis] = outline->middle[axis] + outer;
    }
    outline->radius = radius;
    outline->form[0] = 1 - tangents[0] * tangents[0] / square;
    outline->form[1] = -tangents[0] * tangents[1] / square;
    outline->form[2] = 1 - tangents[1] * tangents[1] / square;
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

// Returns the level of a sphere's probes. The level's bands are at most as high as the sphere's
// radius, unless the level is the last.
static uint32_t level_of(const SphereOutline *outline)
{
    uint32_t level = 0;
    while (level + 1 < REFINE_LEVELS && band_height(level) > outline->radius)
        level++;
    return level;
}

// Adds probes on the rows of a pixel that the sphere covers. If run.level is 0, also adds probes on
// the rows of level 1. These probes are used only if the pixel gets rows of level 1.
static bool add_probes(ProbeList *probes, const SphereOutline *outline, uint32_t column,
                       uint32_t row, ProbeRun run, Error *error)
{
    const double *form = outline->form, radius = outline->radius;
    const double x = outline->middle[0] - (double)column * REFINE_GRID;
    const double y = outline->middle[1] - (double)row * REFINE_GRID;
    const uint32_t step = band_height(run.level > 0 ? run.level : 1);
    bool ok = true;
    for (run.line = step / 2; ok && run.line < REFINE_GRID; run.line += step) {
        const double off = run.line + 0.5 - y, half = form[1] * off;
        const double square = half * half - form[0] * (form[2] * off * off - radius * radius);
        if (square < 0)
            continue;
        run.first = (int)ceil(x - (half + sqrt(square)) / form[0] - 0.5);
        run.end = (int)floor(x - (half - sqrt(square)) / form[0] - 0.5) + 1;
        ok = run.end <= run.first || probe_list_add(probes, &run, error);
    }
    return ok;
}

// If the sphere is thin, records the pixels that it touches, and adds its probes.
static bool add_sphere(ThinParts *parts, const ThinSource *source, const SphereData *sphere,
                       ProbeList *probes, Error *error)
{
    SphereOutline outline;
    bool ok = true;
    if (!project(source->frame, sphere, &outline) || 2 * outline.radius >= THIN_WIDTH)
        return true;
    const CellRange columns = pixels_along(source->frame, &outline, 0);
    const CellRange rows = pixels_along(source->frame, &outline, 1);
    for (uint32_t y = rows.first; ok && y < rows.end; y++)
        for (uint32_t x = columns.first; ok && x < columns.end; x++) {
            const ProbeRun run = {.pixel = y * parts->width + x, .level = level_of(&outline)};
            thin_parts_touch(parts, run.pixel, THIN_ROWS);
            ok = !source->has_probes || add_probes(probes, &outline, x, y, run, error);
        }
    for (size_t i = 0; ok && i < probes->count; i++)
        ok = thin_parts_add(parts, &probes->data[i], error);
    probes->count = 0;
    return ok;
}

static int compare_pixels(const void *a, const void *b)
{
    const uint32_t one = ((const Probe *)a)->pixel, other = ((const Probe *)b)->pixel;
    return (one > other) - (one < other);
}

// Removes the probes of levels that the sample budget does not cover. Sorts the other probes by
// pixel.
static void finish_probes(ThinParts *parts)
{
    const uint32_t levels = thin_parts_affordable(parts);
    size_t kept = 0;
    for (size_t i = 0; i < parts->probes.count; i++)
        if (parts->probes.data[i].level < levels)
            parts->probes.data[kept++] = parts->probes.data[i];
    parts->probes.count = kept;
    if (kept > 0)
        qsort(parts->probes.data, kept, sizeof *parts->probes.data, compare_pixels);
}

bool thin_parts_make(ThinParts *parts, const ThinSource *source, Error *error)
{
    const FrameData *frame = source->frame;
    const size_t pixels = (size_t)frame->width * frame->height;
    *parts = (ThinParts){.width = frame->width, .height = frame->height};
    parts->axes = memory_zeroed(pixels, sizeof *parts->axes, error);
    ProbeList probes = {0};
    bool ok = parts->axes != NULL;
    // With max_level 0, camera rays hit nothing, so there is no need for probes.
    for (uint32_t i = 0; ok && frame->max_level > 0 && i < frame->sphere_count; i++)
        ok = add_sphere(parts, source, &source->spheres[i], &probes, error);
    free(probes.data);
    if (ok && frame->max_level > 0)
        ok = thin_triangles_find(parts, source, error);
    finish_probes(parts);
    if (!ok)
        thin_parts_free(parts);
    return ok;
}

void thin_parts_free(ThinParts *parts)
{
    free(parts->axes);
    free(parts->probes.data);
    *parts = (ThinParts){0};
}
