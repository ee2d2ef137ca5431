// SPDX-License-Identifier: MIT
// Reads a model with Assimp, and sends its files, its parts and a note about omitted data.
#include "foreign/model.h"

#include "foreign/parts.h"
#include "foreign/send.h"

#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <string.h>

// The following functions estimate Assimp's time for polygons, and compare it with a limit. Assimp
// takes at least n * n steps for a polygon of n corners.

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

static bool check_polygons(const Polygons *polygons, Error *error)
{
    return polygons->steps <= STEPS_MOST ||
           error_set(error,
                     "its polygons of up to %u corners take too long to triangulate; PLY files may "
                     "have such polygons if they are convex",
                     polygons->most);
}

static bool check_scene(const struct aiScene *scene, Error *error)
{
    Polygons polygons = {0};
    for (unsigned mesh = 0; mesh < scene->mNumMeshes; mesh++)
        for (unsigned face = 0; face < scene->mMeshes[mesh]->mNumFaces; face++)
            add_polygon(&polygons, scene->mMeshes[mesh]->mFaces[face].mNumIndices);
    return check_polygons(&polygons, error);
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

// Returns false if the polygons of an OBJ file take too long. This check reads the file's text
// before Assimp does, because Assimp 5.4 takes at least n * n steps even to read a face of n
// corners.
static bool check_obj(const File *file, Error *error)
{
    Polygons polygons = {0};
    for (size_t begin = 0, end; begin < file->size; begin = end) {
        end = line_end(file, begin);
        if (file->bytes[begin] == 'f')
            add_polygon(&polygons, count_corners(file->bytes + begin, end - begin));
    }
    return check_polygons(&polygons, error);
}

static bool fail(Error *error)
{
    const char *reason = aiGetErrorString();
    if (strstr(reason, "bad_alloc") != NULL)
        return error_set(error, "Assimp needs more memory than the limit for a file of this size");
    return error_set(error, "Assimp cannot read it: %s",
                     reason[0] != '\0' ? reason : "no reason is given");
}

// Reads and triangulates the model. Returns NULL on failure. The settings prevent Assimp from
// rotating Collada files to y up, and from adding meshes for skeletons.
static const struct aiScene *import(Files *files, Error *error)
{
    struct aiPropertyStore *settings = aiCreatePropertyStore();
    aiSetImportPropertyInteger(settings, AI_CONFIG_IMPORT_NO_SKELETON_MESHES, 1);
    aiSetImportPropertyInteger(settings, AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, 1);
    const struct aiScene *scene =
        aiImportFileExWithProperties(files->model, 0, &files->interface, settings);
    aiReleasePropertyStore(settings);
    if (scene != NULL && !check_scene(scene, error)) {
        aiReleaseImport(scene);
        return NULL;
    }
    scene = scene == NULL ? NULL : aiApplyPostProcessing(scene, aiProcess_Triangulate);
    if (scene == NULL)
        fail(error);
    return scene;
}

static bool lacks_materials(const Files *files)
{
    for (size_t i = 0; i < files->opened.count; i++)
        if (file_has_ending(files->opened.data[i].path, ".mtl"))
            return false;
    return files->missing[0] != '\0';
}

static void send_note(FILE *stream, const Files *files, const PartCounts *counts)
{
    char note[512] = "";
    FILE *text = fmemopen(note, sizeof note, "w");
    if (text == NULL)
        return;
    if (counts->others > 0)
        fprintf(text, "; %zu lines and points are left out", counts->others);
    if (counts->is_textured)
        fputs("; its textures are left out", text);
    if (lacks_materials(files))
        fprintf(text,
                "; its materials, %.200s, cannot be opened: those that it names are gray (0.6 0.6 "
                "0.6)",
                files->missing);
    if (files->outside_count > 0)
        fputs("; it names files outside of its folder, which are not read", text);
    fclose(text);
    if (note[0] != '\0')
        send_text(stream, FOREIGN_NOTE, "%s", note + 2);
}

static void send_files(FILE *stream, const Files *files)
{
    for (size_t i = 0; i < files->opened.count; i++) {
        const OpenedFile *opened = &files->opened.data[i];
        send_file(stream, opened->path, opened->file.bytes, opened->file.size);
    }
}

bool model_send(FILE *stream, Files *files, Error *error)
{
    PartCounts counts;
    if (!files_open_model(files, error) ||
        (file_has_ending(files->model, ".obj") && !check_obj(&files->opened.data[0].file, error)))
        return false;
    const struct aiScene *scene = import(files, error);
    if (scene == NULL)
        return false;
    send_files(stream, files);
    const bool ok =
        parts_send(stream, scene, !file_has_ending(files->model, ".stl"), &counts, error);
    aiReleaseImport(scene);
    if (!ok)
        return false;
    if (counts.triangles == 0 && counts.others > 0)
        return error_set(error, "there are no triangles in it, only %zu lines and points",
                         counts.others);
    if (counts.triangles == 0)
        return error_set(error, "there are no triangles in it");
    send_note(stream, files, &counts);
    send_bytes(stream, FOREIGN_END, "", 0);
    return true;
}
