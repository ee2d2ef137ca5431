// SPDX-License-Identifier: MIT
// Finds the probes of thin spheres, and adds the probes that thin_triangles.c finds.
#include "refine/thin_parts.h"

#include <math.h>
#include <stdlib.h>

// A sphere's outline, which is almost an ellipse around the projected center. A point at the offset
// (x, y) from this center is inside if form[0] x^2 + 2 form[1] x y + form[2] y^2 is at most the
// squared radius. The unit of length is a place.
typedef struct {
    double middle[2];
    double radius; // the shorter radius
    double outer;  // no point of the outline is farther from the center
    double form[3];
} SphereOutline;

// Projects a sphere. Returns false unless the whole sphere is in front of the eye.
static bool project(const Projection *projection, const SphereData *sphere, SphereOutline *outline)
{
    const Vec3 center = projection_point(projection, vec3_of_floats(sphere->center));
    const double square = vec3_dot(projection->right, projection->right);
    const double slant = projection->camera.orthographic != 0 ? 0 : 1 / sqrt(square);
    if (center.z <= sphere->radius)
        return false;
    const double x = center.x / center.z, y = center.y / center.z;
    const double right = slant * (x - projection->width / 2);
    const double down = slant * (y - projection->height / 2);
    const double stretch = 1 + right * right + down * down;
    const double radius = sphere->radius * sqrt(square) / center.z;
    *outline = (SphereOutline){
        .middle = {x, y},
        .radius = radius,
        .outer = radius * sqrt(stretch) * 1.001,
        .form = {1 - right * right / stretch, -right * down / stretch, 1 - down * down / stretch}};
    return true;
}

// Adds probes on the rows of a pixel that the sphere covers. The bands of the probes' level are at
// most as high as the sphere's radius, unless the level is the last. If it is 0, also adds probes
// on the rows of level 1. These probes are used only if the pixel gets rows of level 1.
static bool add_probes(ThinParts *parts, const SphereOutline *outline, uint32_t pixel, Error *error)
{
    const uint32_t width = parts->pixels.counts[0];
    const double x = outline->middle[0] - (double)(pixel % width) * REFINE_GRID;
    const double y = outline->middle[1] - (double)(pixel / width) * REFINE_GRID;
    const double *form = outline->form, radius = outline->radius;
    ProbeRun run = {.pixel = pixel};
    while (run.level + 1 < REFINE_LEVELS && band_height(run.level) > radius)
        run.level++;
    const uint32_t step = band_height(run.level > 0 ? run.level : 1);
    bool ok = true;
    for (run.line = step / 2; ok && run.line < REFINE_GRID; run.line += step) {
        const double off = run.line + 0.5 - y, half = form[1] * off;
        const double square = half * half - form[0] * (form[2] * off * off - radius * radius);
        if (square < 0)
            continue;
        run.first = (int)ceil(x - (half + sqrt(square)) / form[0] - 0.5);
        run.end = (int)floor(x - (half - sqrt(square)) / form[0] - 0.5) + 1;
        ok = run.end <= run.first || probe_list_add(&parts->probes, &run, error);
    }
    return ok;
}

// If the sphere is thin, records the pixels that it touches, and adds its probes.
static bool add_sphere(ThinParts *parts, const Projection *projection, const SphereData *sphere,
                       bool has_probes, Error *error)
{
    const CellGrid *pixels = &parts->pixels;
    SphereOutline outline;
    bool ok = true;
    if (!project(projection, sphere, &outline) || 2 * outline.radius >= THIN_WIDTH)
        return true;
    const double x = outline.middle[0], y = outline.middle[1], outer = outline.outer;
    const OutlineBox box = {{x - outer, y - outer}, {x + outer, y + outer}};
    const CellRange columns = cells_along(&box, pixels, 0, CELL_AREA);
    const CellRange rows = cells_along(&box, pixels, 1, CELL_AREA);
    for (uint32_t row = rows.first; ok && row < rows.end; row++)
        for (uint32_t column = columns.first; ok && column < columns.end; column++) {
            const uint32_t pixel = row * pixels->counts[0] + column;
            thin_parts_touch(parts, pixel, THIN_ROWS);
            ok = !has_probes || add_probes(parts, &outline, pixel, error);
        }
    return ok;
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
        qsort(parts->probes.data, kept, sizeof *parts->probes.data, thin_compare_pixels);
}

bool thin_parts_make(ThinParts *parts, const RefineSetup *setup, const FrameData *frame,
                     bool has_probes, Error *error)
{
    const size_t pixels = (size_t)frame->width * frame->height;
    *parts = (ThinParts){
        .pixels = {REFINE_GRID, 1.0 / REFINE_GRID, {frame->width, frame->height}, {0, 0}}};
    parts->axes = memory_zeroed(pixels, sizeof *parts->axes, error);
    const Projection projection = projection_of(frame, setup->normalization);
    bool ok = parts->axes != NULL;
    // With max_level 0, camera rays hit nothing, so there is no need for probes.
    for (uint32_t i = 0; ok && frame->max_level > 0 && i < frame->sphere_count; i++)
        ok = add_sphere(parts, &projection, &setup->flat->spheres[i], has_probes, error);
    if (ok && frame->max_level > 0)
        ok = thin_triangles_find(parts, setup, frame, has_probes, error);
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
