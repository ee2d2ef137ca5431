// SPDX-License-Identifier: MIT
// Estimates Assimp's time for polygons, and compares it with a limit. Assimp takes at least n * n
// steps for a polygon of n corners.
#include "foreign/polygons.h"

// The largest number of steps for a model. A single polygon of 30,000 corners reaches this limit,
// and takes about five seconds.
#define STEPS_MOST 900000000.0

typedef struct {
    double steps;
    unsigned most; // largest number of corners of a polygon
} Polygons;

static void add_polygon(Polygons *polygons, unsigned corners)
{
    polygons->steps += corners > 4 ? (double)corners * corners : 0;
    polygons->most = corners > polygons->most ? corners : polygons->most;
}

static bool check(const Polygons *polygons, Error *error)
{
    return polygons->steps <= STEPS_MOST ||
           error_set(error,
                     "its polygons of up to %u corners take too long to triangulate; PLY files may "
                     "have such polygons if they are convex",
                     polygons->most);
}

bool polygons_check_scene(const struct aiScene *scene, Error *error)
{
    Polygons polygons = {0};
    for (unsigned mesh = 0; mesh < scene->mNumMeshes; mesh++)
        for (unsigned face = 0; face < scene->mMeshes[mesh]->mNumFaces; face++)
            add_polygon(&polygons, scene->mMeshes[mesh]->mFaces[face].mNumIndices);
    return check(&polygons, error);
}

// Returns the position after the line that starts at `begin`. A backslash before the line feed
// continues the line.
static size_t line_end(const File *file, size_t begin)
{
    for (size_t i = begin; i < file->size; i++)
        if (file->bytes[i] == '\n' && (i == begin || file->bytes[i - 1] != '\\'))
            return i + 1;
    return file->size;
}

static bool is_blank(char byte)
{
    return byte == ' ' || byte == '\t' || byte == '\r' || byte == '\n' || byte == '\\';
}

// Returns the number of words in a line after the first word.
static unsigned count_corners(const char *line, size_t size)
{
    unsigned count = 0;
    for (size_t i = 1; i < size; i++)
        count += is_blank(line[i - 1]) && !is_blank(line[i]);
    return count;
}

bool polygons_check_obj(const File *file, Error *error)
{
    Polygons polygons = {0};
    for (size_t begin = 0, end; begin < file->size; begin = end) {
        end = line_end(file, begin);
        if (file->bytes[begin] == 'f')
            add_polygon(&polygons, count_corners(file->bytes + begin, end - begin));
    }
    return check(&polygons, error);
}
