// SPDX-License-Identifier: MIT
// Writes the PLY file byte by byte, so that it does not depend on the machine's byte order.
#include "ply_file.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

static unsigned char *put_integer(unsigned char *end, uint32_t value)
{
    for (int shift = 0; shift < 32; shift += 8)
        *end++ = (unsigned char)(value >> shift & 0xFF);
    return end;
}

static unsigned char *put_vector(unsigned char *end, Vec3 vector)
{
    const float parts[3] = {(float)vector.x, (float)vector.y, (float)vector.z};
    for (int axis = 0; axis < 3; axis++) {
        uint32_t bits;
        memcpy(&bits, &parts[axis], sizeof bits);
        end = put_integer(end, bits);
    }
    return end;
}

static unsigned char *put_color(unsigned char *end, Vec3 color)
{
    const double parts[3] = {color.x, color.y, color.z};
    for (int channel = 0; channel < 3; channel++)
        *end++ = (unsigned char)(parts[channel] * 255 + 0.5);
    return end;
}

static void write_header(const Surface *surface, bool is_colored, FILE *file)
{
    fprintf(file, "ply\nformat binary_little_endian 1.0\nelement vertex %zu\n",
            surface->vertex_count);
    for (const char *name = "x\0y\0z\0nx\0ny\0nz\0"; *name != '\0'; name += strlen(name) + 1)
        fprintf(file, "property float %s\n", name);
    if (is_colored)
        fputs("property uchar red\nproperty uchar green\nproperty uchar blue\n", file);
    fprintf(file, "element face %zu\n", surface->quad_count * 2);
    fputs("property list uchar int vertex_indices\nend_header\n", file);
}

static void write_vertices(const Surface *surface, PointColor *color, FILE *file)
{
    for (size_t vertex = 0; vertex < surface->vertex_count; vertex++) {
        unsigned char bytes[27], *end = put_vector(bytes, surface->positions[vertex]);
        end = put_vector(end, surface->normals[vertex]);
        if (color != NULL)
            end = put_color(end, color(surface->positions[vertex]));
        fwrite(bytes, (size_t)(end - bytes), 1, file);
    }
}

static void write_faces(const Surface *surface, FILE *file)
{
    for (size_t index = 0; index < surface->quad_count; index++) {
        const uint32_t *quad = surface->quads[index];
        unsigned char bytes[26], *end = bytes;
        for (int triangle = 0; triangle < 2; triangle++) {
            *end++ = 3;
            end = put_integer(end, quad[0]);
            end = put_integer(end, quad[triangle + 1]);
            end = put_integer(end, quad[triangle + 2]);
        }
        fwrite(bytes, sizeof bytes, 1, file);
    }
}

bool ply_file_write(const Surface *surface, PointColor *color, const char *path, Error *error)
{
    FILE *file = fopen(path, "wb");
    if (file == NULL)
        return error_set(error, "cannot write %s: %s", path, strerror(errno));
    write_header(surface, color != NULL, file);
    write_vertices(surface, color, file);
    write_faces(surface, file);
    const bool failed = ferror(file) != 0;
    if (fclose(file) != 0 || failed)
        return error_set(error, "cannot write all of %s: %s", path, strerror(errno));
    return true;
}
