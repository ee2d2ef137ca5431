// SPDX-License-Identifier: MIT
// The fast path for elements whose values have fixed offsets. Reading a value is one load, without
// a function call, a bounds check or a stored position for messages.
#include "mesh/ply_reader.h"

#include <math.h>
#include <string.h>

#define COMPONENTS 6 // x y z nx ny nz, in the order of PlyRole

// The offsets and types of the vertex values that a mesh uses, by PlyRole.
typedef struct {
    size_t offsets[COMPONENTS];
    PlyType types[COMPONENTS];
    size_t stride;
    bool swapped; // the file's byte order differs from the processor's
} VertexLayout;

typedef struct {
    size_t length_offset, stride;
} FaceLayout;

static bool is_swapped(const PlyReader *reader)
{
    return (reader->format == PLY_LITTLE_ENDIAN) != (__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__);
}

static inline uint32_t load_word(const char *bytes, bool swapped)
{
    uint32_t word;
    memcpy(&word, bytes, sizeof word);
    return swapped ? __builtin_bswap32(word) : word;
}

static inline double load_float(const char *bytes, PlyType type, bool swapped)
{
    if (type == PLY_FLOAT32) {
        const uint32_t word = load_word(bytes, swapped);
        float value;
        memcpy(&value, &word, sizeof value);
        return (double)value;
    }
    uint64_t word;
    memcpy(&word, bytes, sizeof word);
    word = swapped ? __builtin_bswap64(word) : word;
    double value;
    memcpy(&value, &word, sizeof value);
    return value;
}

static bool find_vertex_layout(VertexLayout *layout, const PlyReader *reader,
                               PlyProperties properties)
{
    *layout = (VertexLayout){.swapped = is_swapped(reader)};
    for (size_t index = 0; index < properties.count; index++) {
        const PlyProperty *property = &properties.data[index];
        if (property->is_list || (property->role < COMPONENTS && property->type < PLY_FLOAT32))
            return false;
        if (property->role < COMPONENTS) {
            layout->offsets[property->role] = layout->stride;
            layout->types[property->role] = property->type;
        }
        layout->stride += ply_reader_value_size(reader, property->type);
    }
    return reader->format != PLY_ASCII;
}

static inline bool load_position(const VertexLayout *layout, const char *bytes, double position[3])
{
    bool valid = true;
    for (int axis = 0; axis < 3; axis++) {
        const int role = PLY_X + axis;
        position[axis] =
            load_float(bytes + layout->offsets[role], layout->types[role], layout->swapped);
        valid = valid && fabs(position[axis]) < PLY_COORDINATE_BOUND;
    }
    return valid;
}

static inline bool load_normal(const VertexLayout *layout, const char *bytes, float normal[3])
{
    bool valid = true;
    for (int axis = 0; axis < 3; axis++) {
        const int role = PLY_NORMAL_X + axis;
        normal[axis] =
            (float)load_float(bytes + layout->offsets[role], layout->types[role], layout->swapped);
        valid = valid && isfinite(normal[axis]);
    }
    return valid;
}

void ply_bulk_vertices(PlyReader *reader, PlyProperties properties, int64_t count, Mesh *mesh)
{
    VertexLayout layout;
    if (!find_vertex_layout(&layout, reader, properties))
        return;
    const char *bytes = reader->next;
    int64_t index = reader->index;
    while (index < count && (size_t)(reader->end - bytes) >= layout.stride) {
        if (!load_position(&layout, bytes, mesh->positions[index]) ||
            (mesh->normals != NULL && !load_normal(&layout, bytes, mesh->normals[index])))
            break;
        bytes += layout.stride;
        index++;
    }
    reader->next = bytes;
    reader->index = index;
}

// Stores the layout of a face with three corners. Returns false if the layout is unusual.
static bool find_face_layout(FaceLayout *layout, const PlyReader *reader, PlyProperties properties)
{
    *layout = (FaceLayout){0};
    bool has_corners = false;
    for (size_t index = 0; index < properties.count; index++) {
        const PlyProperty *property = &properties.data[index];
        const size_t size = ply_reader_value_size(reader, property->type);
        if (property->role != PLY_CORNERS && property->is_list)
            return false;
        if (property->role == PLY_CORNERS) {
            if (property->length_type > PLY_UINT8 || size != sizeof(uint32_t))
                return false;
            has_corners = true;
            layout->length_offset = layout->stride;
            layout->stride += 1 + 3 * size;
        } else {
            layout->stride += size;
        }
    }
    return has_corners && reader->format != PLY_ASCII;
}

size_t ply_bulk_triangle_size(const PlyReader *reader, PlyProperties properties)
{
    FaceLayout layout;
    return find_face_layout(&layout, reader, properties) ? layout.stride : 0;
}

size_t ply_bulk_triangles(PlyReader *reader, PlyProperties properties, int64_t vertex_count,
                          size_t room, uint32_t (*triangles)[3])
{
    FaceLayout layout;
    if (!find_face_layout(&layout, reader, properties))
        return 0;
    const bool swapped = is_swapped(reader);
    // As an unsigned number, a negative index exceeds every vertex count.
    const uint32_t limit = (uint32_t)vertex_count;
    const char *bytes = reader->next;
    size_t done = 0;
    while (done < room && (size_t)(reader->end - bytes) >= layout.stride) {
        const char *list = bytes + layout.length_offset;
        uint32_t *triangle = triangles[done];
        triangle[0] = load_word(list + 1, swapped);
        triangle[1] = load_word(list + 5, swapped);
        triangle[2] = load_word(list + 9, swapped);
        if (*list != 3 || triangle[0] >= limit || triangle[1] >= limit || triangle[2] >= limit)
            break;
        bytes += layout.stride;
        done++;
    }
    reader->next = bytes;
    reader->index += (int64_t)done;
    return done;
}
