// SPDX-License-Identifier: MIT
// Triangles -> convex polygons in the picture. The functions find the cells that a polygon touches
// and the centers of cells that the polygon contains, and test the polygon's thickness. The unit of
// length is a place (probe.h).
#pragma once

#include "base/thread_pool.h"
#include "scene/camera.h"

#include <stdbool.h>
#include <stdint.h>

// Triangles are clipped by one plane through the eye and four around the picture. Afterwards, they
// have at most OUTLINE_CORNERS corners.
#define CLIPPING_PLANES 5
#define OUTLINE_CORNERS 8

typedef struct {
    double low[2], high[2];
} OutlineBox;

typedef struct {
    uint32_t count;
    double corners[OUTLINE_CORNERS + 1][2]; // in order around the polygon; the first one twice
    OutlineBox box;                         // around the corners
} Outline;

// Extends the box so that it contains the other one.
void outline_box_add(OutlineBox *box, const OutlineBox *other);

// A grid of square cells. The cells are pixels or places.
typedef struct {
    double side, per_length; // per_length is 1 / side
    uint32_t counts[2];      // of columns and of rows
    double origin[2];        // upper left corner of the first cell
} CellGrid;

typedef struct {
    uint32_t first, end;
} CellRange;

static inline bool range_is_empty(CellRange range)
{
    return range.first >= range.end;
}

// Computes everything else from the count and the corners.
void outline_complete(Outline *outline);

static inline uint32_t cell_limit(double value, uint32_t most)
{
    return value > 0 ? (value < most ? (uint32_t)value : most) : 0;
}

// The part of a cell that counts.
typedef enum { CELL_CENTER, CELL_AREA } CellPart;

// Returns the cells along an axis whose parts meet the box.
static inline CellRange cells_along(const OutlineBox *box, const CellGrid *grid, int axis,
                                    CellPart part)
{
    const double first = (box->low[axis] - grid->origin[axis]) * grid->per_length;
    const double last = (box->high[axis] - grid->origin[axis]) * grid->per_length;
    const double half = part == CELL_AREA ? 0.5 : 0; // of the part's side, in cells
    return (CellRange){cell_limit(first + (0.5 - half), grid->counts[axis]),
                       cell_limit(last + (0.5 + half), grid->counts[axis])};
}

// Returns twice the area, negative if the corners are counterclockwise on the screen (y is down).
double outline_signed_area(const Outline *outline);

// Returns whether no disk of the given diameter fits into the polygon. For polygons with more than
// three corners, the result may also be true although a disk of up to twice this diameter fits.
bool outline_is_thinner(const Outline *outline, double diameter);

// Returns the cells of a row whose parts meet the polygon.
CellRange outline_cells(const Outline *outline, const CellGrid *grid, uint32_t row, CellPart part);

// The following declarations project a mesh into the picture. Triangles are clipped to the picture
// and a margin of two pixels.

typedef struct {
    float place[2];   // in places; meaningless if the point is outside
    uint32_t outside; // bit i: the point is beyond clipping plane i
} ProjectedPoint;

typedef struct {
    const MeshObject *object;
    const Normalization *normalization;
    CameraData camera;
    Vec3 right, down;             // the dot product with a point at depth 1 is a position in places
    double width, height;         // of the picture, in places
    Vec3 planes[CLIPPING_PLANES]; // normals; the planes pass through the eye
    ProjectedPoint *points;       // of the mesh's vertices
} Projection;

// Returns a projection without a mesh. The frame's camera must be made for frame->samples samples.
Projection projection_of(const FrameData *frame, const Normalization *normalization);

// Returns the homogeneous coordinates (x * depth, y * depth, depth) of a point that is given in
// normalized coordinates. For an orthographic camera, 1 replaces the depth, and nothing is behind
// the eye.
Vec3 projection_point(const Projection *projection, Vec3 point);

// Projects the vertices of a mesh. The caller frees projection->points.
bool projection_begin(Projection *projection, const MeshObject *object, ThreadPool *pool,
                      Error *error);

// Computes the clipped outline of a triangle. Returns false if the triangle is outside, seen
// edge-on, or one-sided and seen from behind.
bool projection_outline(const Projection *projection, size_t triangle, Outline *outline);

// Computes a box that contains the outline of a triangle. Returns false if the triangle is outside.
static inline bool projection_box(const Projection *projection, size_t triangle, OutlineBox *box)
{
    const uint32_t *vertices = projection->object->mesh.triangles[triangle];
    const ProjectedPoint *a = &projection->points[vertices[0]];
    const ProjectedPoint *b = &projection->points[vertices[1]];
    const ProjectedPoint *c = &projection->points[vertices[2]];
    *box = (OutlineBox){{0, 0}, {projection->width, projection->height}};
    if ((a->outside | b->outside | c->outside) != 0)
        return (a->outside & b->outside & c->outside) == 0;
    for (int axis = 0; axis < 2; axis++) {
        const float x = a->place[axis], y = b->place[axis], z = c->place[axis];
        const float lower = x < y ? x : y, upper = x > y ? x : y;
        box->low[axis] = (double)(z < lower ? z : lower);
        box->high[axis] = (double)(z > upper ? z : upper);
    }
    return true;
}
