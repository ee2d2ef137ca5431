// SPDX-License-Identifier: MIT
// Writes numbers in the machine's byte order.
#include "mesh/ply_write.h"

#include "mesh/ply_reader.h"

#include <string.h>

#define HEADER_SIZE 512
#define FACE_SIZE   13 // bytes: a 1-byte count and three 4-byte indices

typedef struct {
    char text[HEADER_SIZE];
    size_t length;
    bool is_double; // positions are doubles
    bool is_byte;   // colors are bytes
} Header;

static bool holds_floats(const Mesh *mesh)
{
    for (size_t vertex = 0; vertex < mesh->vertex_count; vertex++)
        for (int axis = 0; axis < 3; axis++) {
            const double value = mesh->positions[vertex][axis];
            if ((double)(float)value != value)
                return false;
        }
    return true;
}

static unsigned char nearest_byte(float part)
{
    return (unsigned char)(part * 255 + 0.5F);
}

static bool holds_bytes(const Mesh *mesh)
{
    for (size_t vertex = 0; mesh->colors != NULL && vertex < mesh->vertex_count; vertex++)
        for (int channel = 0; channel < 3; channel++) {
            const float part = mesh->colors[vertex][channel];
            if (!(part >= 0 && part <= 1) ||
                ply_reader_color(PLY_UINT8, nearest_byte(part)) != part)
                return false;
        }
    return true;
}

static void add_properties(Header *header, const char *type, const char *const names[3])
{
    for (int i = 0; i < 3; i++)
        header->length +=
            (size_t)snprintf(header->text + header->length, sizeof header->text - header->length,
                             "property %s %s\n", type, names[i]);
}

static Header header_of(const Mesh *mesh)
{
    static const char *const positions[] = {"x", "y", "z"}, *const normals[] = {"nx", "ny", "nz"},
                             *const colors[] = {"red", "green", "blue"};
    Header header = {.is_double = !holds_floats(mesh), .is_byte = holds_bytes(mesh)};
    header.length = (size_t)snprintf(
        header.text, sizeof header.text, "ply\nformat binary_%s_endian 1.0\nelement vertex %zu\n",
        __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__ ? "little" : "big", mesh->vertex_count);
    add_properties(&header, header.is_double ? "double" : "float", positions);
    if (mesh->normals != NULL)
        add_properties(&header, "float", normals);
    if (mesh->colors != NULL)
        add_properties(&header, header.is_byte ? "uchar" : "float", colors);
    header.length +=
        (size_t)snprintf(header.text + header.length, sizeof header.text - header.length,
                         "element face %zu\nproperty list uchar int vertex_indices\nend_header\n",
                         mesh->triangle_count);
    return header;
}

static size_t vertex_size(const Mesh *mesh, const Header *header)
{
    return 3 * (header->is_double ? sizeof(double) : sizeof(float)) +
           (mesh->normals != NULL ? 3 * sizeof(float) : 0) +
           (mesh->colors == NULL ? 0
            : header->is_byte    ? 3
                                 : 3 * sizeof(float));
}

size_t ply_write_size(const Mesh *mesh)
{
    const Header header = header_of(mesh);
    return header.length + mesh->vertex_count * vertex_size(mesh, &header) +
           mesh->triangle_count * FACE_SIZE;
}

static char *put(char *end, const void *value, size_t size)
{
    memcpy(end, value, size);
    return end + size;
}

static char *put_color(char *end, const float color[3], bool is_byte)
{
    if (!is_byte)
        return put(end, color, 3 * sizeof *color);
    for (int channel = 0; channel < 3; channel++)
        *end++ = (char)nearest_byte(color[channel]);
    return end;
}

static void write_vertices(const Mesh *mesh, const Header *header, FILE *stream)
{
    const bool is_double = header->is_double;
    for (size_t vertex = 0; vertex < mesh->vertex_count; vertex++) {
        char bytes[3 * sizeof(double) + 6 * sizeof(float)], *end = bytes;
        for (int axis = 0; axis < 3; axis++) {
            const double value = mesh->positions[vertex][axis];
            const float narrowed = (float)value;
            end = is_double ? put(end, &value, sizeof value) : put(end, &narrowed, sizeof narrowed);
        }
        if (mesh->normals != NULL)
            end = put(end, mesh->normals[vertex], sizeof *mesh->normals);
        if (mesh->colors != NULL)
            end = put_color(end, mesh->colors[vertex], header->is_byte);
        fwrite(bytes, (size_t)(end - bytes), 1, stream);
    }
}

static void write_faces(const Mesh *mesh, FILE *stream)
{
    for (size_t triangle = 0; triangle < mesh->triangle_count; triangle++) {
        char bytes[FACE_SIZE] = {3};
        put(bytes + 1, mesh->triangles[triangle], sizeof *mesh->triangles);
        fwrite(bytes, sizeof bytes, 1, stream);
    }
}

bool ply_write(const Mesh *mesh, FILE *stream)
{
    const Header header = header_of(mesh);
    fwrite(header.text, header.length, 1, stream);
    write_vertices(mesh, &header, stream);
    write_faces(mesh, stream);
    return ferror(stream) == 0;
}
