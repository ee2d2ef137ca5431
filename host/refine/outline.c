// SPDX-License-Identifier: MIT
// Clips triangles, and finds the cells of a row that a polygon touches. The part of a convex
// polygon between two horizontal lines is convex. In each row, the polygon therefore touches
// consecutive cells, from its smallest to its largest x between the row's edges.
#include "refine/outline.h"

#include "refine/probe.h"

#include <math.h>
#include <string.h>

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

void outline_box_add(OutlineBox *box, const OutlineBox *other)
{
    for (int axis = 0; axis < 2; axis++) {
        box->low[axis] = smaller(box->low[axis], other->low[axis]);
        box->high[axis] = larger(box->high[axis], other->high[axis]);
    }
}

void outline_complete(Outline *outline)
{
    outline->box = (OutlineBox){{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    memcpy(outline->corners[outline->count], outline->corners[0], sizeof outline->corners[0]);
    for (uint32_t i = 0; i < outline->count; i++) {
        const double *corner = outline->corners[i];
        const OutlineBox point = {{corner[0], corner[1]}, {corner[0], corner[1]}};
        outline_box_add(&outline->box, &point);
    }
}

static double perimeter_of(const Outline *outline)
{
    double perimeter = 0;
    for (uint32_t i = 0; i < outline->count; i++) {
        const double *from = outline->corners[i], *to = outline->corners[i + 1];
        const double x = to[0] - from[0], y = to[1] - from[1];
        perimeter += sqrt(x * x + y * y);
    }
    return perimeter;
}

// Estimates the inradius from the area and the perimeter. The area of a triangle is half its
// perimeter times its inradius. The area of any other convex polygon is at least this product and
// at most twice this product.
bool outline_is_thinner(const Outline *outline, double diameter)
{
    const double area = fabs(outline_signed_area(outline)) / 2;
    return (outline->count == 3 ? 4 : 2) * area < diameter * perimeter_of(outline);
}

// Stores the smallest and the largest x of the polygon's points with y in [low, high] in the box.
// Returns false if the polygon has no such point.
static bool find_extent(const Outline *outline, double low, double high, OutlineBox *box)
{
    box->low[0] = INFINITY;
    box->high[0] = -INFINITY;
    for (uint32_t i = 0; i < outline->count; i++) {
        const double *one = outline->corners[i], *other = outline->corners[i + 1];
        const double *from = one[1] < other[1] ? one : other;
        const double *to = one[1] < other[1] ? other : one;
        if (to[1] < low || from[1] > high)
            continue;
        const double slope = (to[0] - from[0]) / (to[1] - from[1]);
        const double start = from[1] < low ? from[0] + (low - from[1]) * slope : from[0];
        const double end = to[1] > high ? from[0] + (high - from[1]) * slope : to[0];
        box->low[0] = smaller(box->low[0], smaller(start, end));
        box->high[0] = larger(box->high[0], larger(start, end));
    }
    return box->low[0] <= box->high[0];
}

CellRange outline_cells(const Outline *outline, const CellGrid *grid, uint32_t row, CellPart part)
{
    OutlineBox box = outline->box;
    const double middle = grid->origin[1] + (row + 0.5) * grid->side;
    const double half = part == CELL_AREA ? grid->side / 2 : 0;
    const double top = middle - half, bottom = middle + half;
    const bool is_all = box.low[1] >= top && box.high[1] <= bottom;
    if (!is_all && !find_extent(outline, top, bottom, &box))
        return (CellRange){0, 0};
    return cells_along(&box, grid, 0, part);
}

// The following functions project triangles, and clip them in homogeneous coordinates. After the
// division by depth, all coordinates are bounded.

// The distance between the picture's border and the clipping planes.
#define MARGIN (2 * REFINE_GRID)

Vec3 projection_point(const Projection *projection, Vec3 point)
{
    const CameraData *camera = &projection->camera;
    const Vec3 seen = vec3_sub(point, vec3_of_floats(camera->eye));
    const double depth = camera_reduction(camera, vec3_dot(seen, vec3_of_floats(camera->forward)));
    return (Vec3){vec3_dot(seen, projection->right) + projection->width / 2 * depth,
                  vec3_dot(seen, projection->down) + projection->height / 2 * depth, depth};
}

static Vec3 point_of(const Projection *projection, size_t vertex)
{
    const double *position = projection->object->mesh.positions[vertex];
    return projection_point(projection,
                            normalize_point(projection->normalization, vec3_of_doubles(position)));
}

// Returns a bit for each plane beyond which the point is.
static uint32_t planes_crossed(const Projection *projection, Vec3 point)
{
    uint32_t crossed = 0;
    for (int plane = 0; plane < CLIPPING_PLANES; plane++)
        crossed |= (uint32_t) !(vec3_dot(projection->planes[plane], point) > 0) << plane;
    return crossed;
}

static void project_points(void *context, uint32_t first, uint32_t end)
{
    const Projection *projection = context;
    const double right = projection->width + MARGIN, bottom = projection->height + MARGIN;
    for (uint32_t vertex = first; vertex < end; vertex++) {
        const Vec3 point = point_of(projection, vertex);
        const double x = point.x / point.z, y = point.y / point.z;
        const bool is_inside = point.z > 0 && x > -MARGIN && x < right && y > -MARGIN && y < bottom;
        projection->points[vertex] = (ProjectedPoint){
            {(float)x, (float)y}, is_inside ? 0 : planes_crossed(projection, point)};
    }
}

Projection projection_of(const FrameData *frame, const Normalization *normalization)
{
    const double scale = (double)frame->samples / REFINE_GRID;
    const Vec3 right = vec3_scale(vec3_of_floats(frame->camera.right_step), scale);
    const Vec3 down = vec3_scale(vec3_of_floats(frame->camera.down_step), scale);
    const double square = vec3_dot(right, right);
    const double width = (double)frame->width * REFINE_GRID;
    const double height = (double)frame->height * REFINE_GRID;
    return (Projection){.normalization = normalization,
                        .camera = frame->camera,
                        .right = vec3_scale(right, 0.5 / square),
                        .down = vec3_scale(down, 0.5 / square),
                        .width = width,
                        .height = height,
                        .planes = {{0, 0, 1},
                                   {1, 0, MARGIN},
                                   {-1, 0, width + MARGIN},
                                   {0, 1, MARGIN},
                                   {0, -1, height + MARGIN}}};
}

bool projection_begin(Projection *projection, const MeshObject *object, ThreadPool *pool,
                      Error *error)
{
    const uint32_t count = (uint32_t)object->mesh.vertex_count;
    projection->object = object;
    projection->points = memory_raw(count, sizeof *projection->points, error);
    if (projection->points == NULL)
        return false;
    thread_pool_share(pool, count, CHUNK_ELEMENTS, project_points, projection);
    return true;
}

typedef struct {
    uint32_t count;
    Vec3 corners[OUTLINE_CORNERS];
} Polygon;

// Clips a polygon by a plane with this normal.
static void keep_inside(Polygon *polygon, Vec3 normal)
{
    Polygon kept = {0};
    for (uint32_t i = 0; i < polygon->count; i++) {
        const Vec3 from = polygon->corners[i], to = polygon->corners[(i + 1) % polygon->count];
        const double before = vec3_dot(normal, from), after = vec3_dot(normal, to);
        if (before > 0)
            kept.corners[kept.count++] = from;
        if ((before > 0) != (after > 0) && kept.count < OUTLINE_CORNERS)
            kept.corners[kept.count++] =
                vec3_add(from, vec3_scale(vec3_sub(to, from), before / (before - after)));
        if (kept.count == OUTLINE_CORNERS)
            break;
    }
    *polygon = kept;
}

// Limits a coordinate, because rounding may move corners near the eye arbitrarily far.
static double limited(double value, double size)
{
    return value > -MARGIN ? (value < size + MARGIN ? value : size + MARGIN) : -MARGIN;
}

// Clips a triangle that is partly outside. Such triangles are rare. Returns false if nothing
// remains.
static bool cut_outline(const Projection *projection, const uint32_t vertices[3], Outline *outline)
{
    Polygon polygon = {.count = 3};
    for (int corner = 0; corner < 3; corner++)
        polygon.corners[corner] = point_of(projection, vertices[corner]);
    for (int plane = 0; plane < CLIPPING_PLANES; plane++)
        keep_inside(&polygon, projection->planes[plane]);
    if (polygon.count < 3)
        return false;
    outline->count = polygon.count;
    for (uint32_t i = 0; i < polygon.count; i++) {
        const Vec3 *corner = &polygon.corners[i];
        outline->corners[i][0] = limited(corner->x / corner->z, projection->width);
        outline->corners[i][1] = limited(corner->y / corner->z, projection->height);
    }
    return true;
}

// Sets members one by one, because an initializer would clear all OUTLINE_CORNERS corners.
bool projection_outline(const Projection *projection, size_t triangle, Outline *outline)
{
    const uint32_t *vertices = projection->object->mesh.triangles[triangle];
    uint32_t all = UINT32_MAX, any = 0; // planes beyond which all corners or any corners are
    outline->count = 3;
    for (int corner = 0; corner < 3; corner++) {
        const ProjectedPoint *point = &projection->points[vertices[corner]];
        all &= point->outside;
        any |= point->outside;
        outline->corners[corner][0] = point->place[0];
        outline->corners[corner][1] = point->place[1];
    }
    if (all != 0 || (any != 0 && !cut_outline(projection, vertices, outline)))
        return false;
    const double area = outline_signed_area(outline);
    if (!(area < 0 || (area > 0 && projection->object->two_sided)))
        return false;
    outline_complete(outline);
    return true;
}
