// SPDX-License-Identifier: MIT
// Finds the shortest edge and the lowest height of all triangles. Squared lengths are compared, so
// only a new minimum needs a square root.
#include "check/features.h"

#define FLOAT_DIGITS 23 // bits of a float's fraction

typedef struct {
    Vec3 corners[3];
} Shape;

static Shape shape_of(const Mesh *mesh, size_t triangle)
{
    Shape shape;
    for (int corner = 0; corner < 3; corner++)
        shape.corners[corner] = mesh_corner(mesh, triangle, corner);
    return shape;
}

static Vec3 doubled_area(const Shape *shape)
{
    return vec3_cross(vec3_sub(shape->corners[1], shape->corners[0]),
                      vec3_sub(shape->corners[2], shape->corners[0]));
}

// Scales a shape by a power of two. Without scaling, squares of a file's coordinates might overflow
// or underflow in fp64.
static Shape scaled_shape(const Shape *shape, double scale)
{
    return (Shape){{vec3_scale(shape->corners[0], scale), vec3_scale(shape->corners[1], scale),
                    vec3_scale(shape->corners[2], scale)}};
}

// Returns whether the corners are on one line, within the rounding of fp64. First scales the
// longest edge to about 1, because the area of a tiny triangle may underflow in fp64.
static bool is_flat(const Shape *shape)
{
    const double size = fmax(vec3_extent(vec3_sub(shape->corners[1], shape->corners[0])),
                             vec3_extent(vec3_sub(shape->corners[2], shape->corners[0])));
    const Shape scaled = scaled_shape(shape, scalbn(1, size > 0x1p-1000 ? -ilogb(size) : 1000));
    return vec3_extent(doubled_area(&scaled)) == 0;
}

// Returns the spacing of floats at the shape's largest coordinate.
static double step_at(const Shape *shape)
{
    double largest = 0x1p-126;
    for (int corner = 0; corner < 3; corner++)
        largest = fmax(largest, vec3_extent(shape->corners[corner]));
    return scalbn(1, ilogb(largest) - FLOAT_DIGITS);
}

// The squared lengths of the shortest and the longest edge.
typedef struct {
    double shortest, longest;
} EdgeSquares;

static EdgeSquares edge_squares(const Shape *shape)
{
    EdgeSquares squares = {INFINITY, 0};
    for (int corner = 0; corner < 3; corner++) {
        const Vec3 edge = vec3_sub(shape->corners[(corner + 1) % 3], shape->corners[corner]);
        const double square = vec3_dot(edge, edge);
        squares.shortest = fmin(squares.shortest, square);
        squares.longest = fmax(squares.longest, square);
    }
    return squares;
}

static void take_shorter(Feature *feature, double square, double step, size_t triangle)
{
    if (!(square < feature->steps * step * (feature->steps * step)))
        return;
    feature->size = sqrt(square);
    feature->steps = feature->size / step;
    feature->triangle = triangle;
}

static Shape normalized_shape(const Shape *shape, const Normalization *normalization)
{
    Shape moved;
    for (int corner = 0; corner < 3; corner++)
        moved.corners[corner] = normalize_point(normalization, shape->corners[corner]);
    return moved;
}

static void add_normalized(Features *features, const Shape *shape, size_t triangle)
{
    const double step = step_at(shape);
    const EdgeSquares squares = edge_squares(shape);
    take_shorter(&features->edge, squares.shortest, step, triangle);
    const Vec3 area = doubled_area(shape);
    const double height_square = vec3_dot(area, area) / squares.longest;
    if (height_square > 0)
        take_shorter(&features->height, height_square, step, triangle);
}

static bool is_float(Vec3 v)
{
    return (double)(float)v.x == v.x && (double)(float)v.y == v.y && (double)(float)v.z == v.z;
}

static void find_bounds(Features *features, const Mesh *mesh)
{
    const BoundingBox box = mesh_bounds(mesh);
    if (mesh->triangle_count == 0)
        return;
    features->extent = vec3_extent(bounding_box_sides(&box));
    features->offset = vec3_extent(bounding_box_center(&box));
}

Features features_of(const Mesh *mesh, const Normalization *normalization)
{
    const double scale = normalization->scale;
    Features features = {.edge.steps = INFINITY,
                         .height.steps = INFINITY,
                         .written_edge.steps = INFINITY,
                         .holds_floats = true};
    find_bounds(&features, mesh);
    for (size_t triangle = 0; triangle < mesh->triangle_count; triangle++) {
        const Shape written = shape_of(mesh, triangle);
        const Shape scaled = scaled_shape(&written, scale);
        const Shape normalized = normalized_shape(&written, normalization);
        take_shorter(&features.written_edge, edge_squares(&scaled).shortest, step_at(&scaled),
                     triangle);
        add_normalized(&features, &normalized, triangle);
        if (is_flat(&written))
            mesh_fault_add(&features.flat, triangle);
        for (int corner = 0; corner < 3; corner++)
            features.holds_floats = features.holds_floats && is_float(written.corners[corner]);
    }
    features.edge.size /= scale;
    features.height.size /= scale;
    features.written_edge.size /= scale;
    return features;
}

static MeshFault flat_triangles(const Mesh *mesh)
{
    MeshFault flat = {0};
    for (size_t triangle = 0; triangle < mesh->triangle_count; triangle++) {
        const Shape shape = shape_of(mesh, triangle);
        if (is_flat(&shape))
            mesh_fault_add(&flat, mesh_original_number(mesh, triangle));
    }
    return flat;
}

// Returns whether no triangle of the object has the fault. Otherwise, fills `error` with a message
// that contains `text`.
static bool has_none(const Scene *scene, const MeshObject *object, MeshFault fault,
                     const char *text, Error *error)
{
    return fault.count == 0 ||
           error_set(error, "%s: triangle %zu %s (triangles with this fault: %zu)",
                     scene->inputs.data[object->input], fault.first + object->number_before, text,
                     fault.count);
}

bool features_check_dropped(const Scene *scene, Error *error)
{
    bool ok = true;
    for (size_t i = 0; ok && i < scene->objects.count; i++) {
        const MeshObject *object = &scene->objects.data[i];
        ok = has_none(scene, object, object->mesh.equal_corners,
                      "has two equal corners and is left out", error);
    }
    return ok;
}

bool features_check_areas(const Scene *scene, Error *error)
{
    bool ok = true;
    for (size_t i = 0; ok && i < scene->objects.count; i++) {
        const MeshObject *object = &scene->objects.data[i];
        ok = has_none(scene, object, object->mesh.equal_corners, "has two equal corners", error) &&
             has_none(scene, object, flat_triangles(&object->mesh), "has its corners on a line",
                      error);
    }
    return ok;
}
