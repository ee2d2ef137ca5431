// SPDX-License-Identifier: MIT
// Writes numbers in the machine's byte order, which ply_parse reads fastest.
#include "mesh/ply_write.h"

#include <string.h>

#define HEADER_SIZE 512
#define FACE_SIZE   13 // bytes: a 1-byte count and three 4-byte indices

typedef struct {
    char text[HEADER_SIZE];
    size_t length;
    bool is_double;
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

static Header header_of(const Mesh *mesh)
{
    Header header = {.is_double = !holds_floats(mesh)};
    const char *type = header.is_double ? "double" : "float";
    header.length = (size_t)snprintf(
        header.text, sizeof header.text,
        "ply\nformat binary_%s_endian 1.0\nelement vertex %zu\n"
        "property %s x\nproperty %s y\nproperty %s z\n%s"
        "element face %zu\nproperty list uchar int vertex_indices\nend_header\n",
        __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__ ? "little" : "big", mesh->vertex_count, type,
        type, type,
        mesh->normals != NULL ? "property float nx\nproperty float ny\nproperty float nz\n" : "",
        mesh->triangle_count);
    return header;
}

static size_t vertex_size(const Mesh *mesh, bool is_double)
{
    return 3 * (is_double ? sizeof(double) : sizeof(float)) +
           (mesh->normals != NULL ? 3 * sizeof(float) : 0);
}

size_t ply_write_size(const Mesh *mesh)
{
    const Header header = header_of(mesh);
    return header.length + mesh->vertex_count * vertex_size(mesh, header.is_double) +
           mesh->triangle_count * FACE_SIZE;
}

static char *put(char *end, const void *value, size_t size)
{
    memcpy(end, value, size);
    return end + size;
}

static void write_vertices(const Mesh *mesh, bool is_double, FILE *stream)
{
    for (size_t vertex = 0; vertex < mesh->vertex_count; vertex++) {
        char bytes[3 * sizeof(double) + 3 * sizeof(float)], *end = bytes;
        for (int axis = 0; axis < 3; axis++) {
            const double value = mesh->positions[vertex][axis];
            const float narrowed = (float)value;
            end = is_double ? put(end, &value, sizeof value) : put(end, &narrowed, sizeof narrowed);
        }
        if (mesh->normals != NULL)
            end = put(end, mesh->normals[vertex], sizeof *mesh->normals);
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
    write_vertices(mesh, header.is_double, stream);
    write_faces(mesh, stream);
    return ferror(stream) == 0;
}
