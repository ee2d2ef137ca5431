// SPDX-License-Identifier: MIT
// Converts PLY elements to vertices and triangles. ply_header.c parses the header, which lists the
// elements, and ply_reader.c reads the values.
//
// A file may list its faces before its vertices. Triangles with equal corners are therefore dropped
// only after the last element.
//
// Invariant: each count is checked against the file's size before it is used. Each vertex index is
// checked against the vertex count.
#include "mesh/ply.h"

#include "mesh/ply_header.h"

#include <math.h>

typedef struct {
    PlyReader reader;
    PlyHeader header;
    Mesh *mesh;
    ARRAY(Triangle) triangles;
    size_t last_bad_position, last_bad_normal; // latest bad vertices, to count each only once
} Loader;

static void count_once(MeshFault *fault, size_t *last, size_t vertex)
{
    if (fault->count == 0 || *last != vertex)
        mesh_fault_add(fault, vertex);
    *last = vertex;
}

// Returns `value`, or a replacement if the value is not finite or too large. The replacement is 0
// in a normal, and NaN in a position until mesh_drop_triangles sets the position to zero.
static double replace_bad_value(Loader *loader, PlyRole role, double value)
{
    const size_t vertex = (size_t)loader->reader.index;
    Mesh *mesh = loader->mesh;
    if (role <= PLY_Z && !(fabs(value) < PLY_COORDINATE_BOUND)) {
        count_once(&mesh->bad_positions, &loader->last_bad_position, vertex);
        return (double)NAN;
    }
    if (role > PLY_Z && !isfinite((float)value)) {
        count_once(&mesh->bad_normals, &loader->last_bad_normal, vertex);
        return 0;
    }
    return value;
}

static bool read_component(Loader *loader, const PlyProperty *property)
{
    static const char *const names[] = {"x", "y", "z", "nx", "ny", "nz"};
    PlyReader *reader = &loader->reader;
    double value;
    if (!ply_reader_read_number(reader, property->type, &value))
        return false;
    if (property->role >= PLY_RED) {
        loader->mesh->colors[reader->index][property->role - PLY_RED] =
            ply_reader_color(property->type, value);
        return true;
    }
    const char *name = names[property->role];
    if (reader->is_tolerant)
        value = replace_bad_value(loader, property->role, value);
    if (property->role <= PLY_Z) {
        if (!(fabs(value) < PLY_COORDINATE_BOUND) && !reader->is_tolerant)
            return ply_reader_fail(reader, "%s is %g, not a finite number below 1e30 in size", name,
                                   value);
        loader->mesh->positions[reader->index][property->role - PLY_X] = value;
        return true;
    }
    const float narrowed = (float)value;
    if (!isfinite(narrowed))
        return ply_reader_fail(reader, "%s is %g, not a finite single precision number", name,
                               value);
    loader->mesh->normals[reader->index][property->role - PLY_NORMAL_X] = narrowed;
    return true;
}

static bool read_length(PlyReader *reader, const PlyProperty *property, int64_t *length)
{
    if (!ply_reader_read_integer(reader, property->length_type, length))
        return false;
    return *length >= 0 ||
           ply_reader_fail(reader, "list length %lld is negative", (long long)*length);
}

// Reads and checks an index of a vertex. In a list of strips, -1 is valid too.
static bool read_corner(Loader *loader, const PlyProperty *property, PlyKind kind, int64_t *corner)
{
    PlyReader *reader = &loader->reader;
    if (!ply_reader_read_integer(reader, property->type, corner))
        return false;
    const int64_t vertex = *corner;
    if (vertex < 0 && !(vertex == -1 && kind == PLY_STRIPS))
        return ply_reader_fail(reader, "vertex index %lld is negative", (long long)vertex);
    if (vertex >= loader->header.vertex_count)
        return ply_reader_fail(reader, "vertex index %lld is not below the vertex count %lld",
                               (long long)vertex, (long long)loader->header.vertex_count);
    return true;
}

// Checks a list's corner count and reserves memory for its triangles.
static bool reserve_triangles(Loader *loader, const PlyProperty *property, int64_t length)
{
    PlyReader *reader = &loader->reader;
    const size_t count = loader->triangles.count;
    if (length - 2 > PLY_COUNT_LIMIT - (int64_t)count)
        return ply_reader_fail(reader, "its %lld corners bring the triangle count above %lld",
                               (long long)length, (long long)PLY_COUNT_LIMIT);
    return ply_reader_check_room(reader, length, ply_reader_value_size(reader, property->type)) &&
           array_reserve(&loader->triangles.memory, &loader->triangles.capacity,
                         count + (length > 2 ? (size_t)length - 2 : 0), sizeof(Triangle),
                         reader->error);
}

static void add_triangle(Loader *loader, int64_t a, int64_t b, int64_t c)
{
    uint32_t *triangle = loader->triangles.data[loader->triangles.count++];
    triangle[0] = (uint32_t)a;
    triangle[1] = (uint32_t)b;
    triangle[2] = (uint32_t)c;
}

static bool read_polygon(Loader *loader, const PlyProperty *property, int64_t length)
{
    int64_t first, previous, corner;
    if (length < 3)
        return ply_reader_fail(&loader->reader, "a face needs 3 or more corners, not %lld",
                               (long long)length);
    if (!reserve_triangles(loader, property, length) ||
        !read_corner(loader, property, PLY_FACE, &first) ||
        !read_corner(loader, property, PLY_FACE, &previous))
        return false;
    for (int64_t index = 2; index < length; index++, previous = corner) {
        if (!read_corner(loader, property, PLY_FACE, &corner))
            return false;
        add_triangle(loader, first, previous, corner);
    }
    return true;
}

// Reads a list of triangle strips. Three consecutive corners form a triangle, and the index -1 ends
// a strip. Every second triangle takes its first two corners in reverse order, so that all
// triangles of a strip face the same side. last[1] holds the latest of the strip's corners 1, 3, 5
// and so on, and last[0] holds the latest of the other corners.
static bool read_strips(Loader *loader, const PlyProperty *property, int64_t length)
{
    int64_t last[2] = {0, 0}, corner, held = 0;
    if (!reserve_triangles(loader, property, length))
        return false;
    for (int64_t index = 0; index < length; index++) {
        if (!read_corner(loader, property, PLY_STRIPS, &corner))
            return false;
        held = corner < 0 ? 0 : held + 1;
        if (held > 2)
            add_triangle(loader, last[1], last[0], corner);
        last[held % 2] = corner;
    }
    return true;
}

static bool read_corners(Loader *loader, const PlyElement *element, const PlyProperty *property)
{
    int64_t length;
    if (!read_length(&loader->reader, property, &length))
        return false;
    return element->kind == PLY_FACE ? read_polygon(loader, property, length)
                                     : read_strips(loader, property, length);
}

static bool skip_property(PlyReader *reader, const PlyProperty *property)
{
    const size_t size = ply_reader_value_size(reader, property->type);
    int64_t length = 1;
    if (property->is_list &&
        (!read_length(reader, property, &length) || !ply_reader_check_room(reader, length, size)))
        return false;
    return ply_reader_skip_values(reader, property->type, length);
}

static bool read_property(Loader *loader, const PlyElement *element, const PlyProperty *property)
{
    if (property->role == PLY_UNUSED)
        return skip_property(&loader->reader, property);
    if (property->role == PLY_CORNERS)
        return read_corners(loader, element, property);
    return read_component(loader, property);
}

static bool allocate_vertices(Loader *loader)
{
    const PlyHeader *header = &loader->header;
    loader->mesh->vertex_count = (size_t)header->vertex_count;
    return mesh_allocate_vertices(loader->mesh, header->has_normals, header->has_colors,
                                  loader->reader.error);
}

// Returns the smallest possible size of an element in bytes. All lists of such an element are
// empty.
static size_t smallest_size(const PlyReader *reader, PlyProperties properties)
{
    size_t size = 0;
    for (size_t index = 0; index < properties.count; index++) {
        const PlyProperty *property = &properties.data[index];
        size += ply_reader_value_size(reader,
                                      property->is_list ? property->length_type : property->type);
    }
    return size;
}

static bool read_element(Loader *loader, const PlyElement *element)
{
    PlyReader *reader = &loader->reader;
    if (element->property_count == 0) // such elements take no bytes, so any count is valid
        return true;
    const PlyProperties properties = ply_header_properties(&loader->header, element);
    reader->element = element->name;
    reader->index = -1;
    const size_t size = smallest_size(reader, properties);
    if (!ply_reader_check_room(reader, element->count, size))
        return false;
    if (element->kind == PLY_VERTEX && element->count > 0 && !allocate_vertices(loader))
        return false;
    for (reader->index = 0; reader->index < element->count; reader->index++) {
        for (size_t index = 0; index < properties.count; index++) {
            if (!read_property(loader, element, &properties.data[index]))
                return false;
        }
    }
    return true;
}

static bool read_elements(Loader *loader)
{
    for (size_t index = 0; index < loader->header.elements.count; index++) {
        if (!read_element(loader, &loader->header.elements.data[index]))
            return false;
    }
    return true;
}

// Fails if the file has no triangles but has elements that the parser skips.
static bool check_elements(const Loader *loader)
{
    PlyReader reader = loader->reader;
    for (size_t index = 0; index < loader->header.elements.count; index++) {
        const PlyElement *element = &loader->header.elements.data[index];
        if (loader->triangles.count > 0 || element->kind != PLY_OTHER || element->count == 0 ||
            element->property_count == 0)
            continue;
        reader.place = element->name.start;
        reader.format = PLY_ASCII; // the header is text
        reader.element = element->name;
        reader.index = -1;
        return ply_reader_fail(&reader, "there is nothing to draw: the file has no triangles, and "
                                        "clrt does not read this element");
    }
    return true;
}

bool ply_parse(Mesh *mesh, const PlySource *source, Error *error)
{
    Loader loader = {
        .reader = {.name = source->name,
                   .start = source->bytes,
                   .end = source->size == 0 ? source->bytes : source->bytes + source->size,
                   .is_tolerant = source->is_tolerant,
                   .is_part = source->is_part,
                   .error = error},
        .mesh = mesh};
    *mesh = (Mesh){0};
    bool ok = ply_header_parse(&loader.header, &loader.reader) && read_elements(&loader) &&
              check_elements(&loader);
    mesh->triangles = loader.triangles.data;
    mesh->triangle_count = loader.triangles.count;
    ply_header_free(&loader.header);
    ok = ok && mesh_drop_triangles(mesh, error);
    if (!ok)
        mesh_free(mesh);
    return ok;
}
