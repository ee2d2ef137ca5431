// SPDX-License-Identifier: MIT
// clrt-foreign PATH: reads one model with Assimp and writes it to standard output as
// scene/foreign_stream.h says.  clrt starts it, and nobody else.
#include "foreign/files.h"
#include "foreign/limits.h"
#include "foreign/parts.h"
#include "foreign/send.h"

#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

// The pipe, out of the way of importers that print.
static FILE *take_output(void)
{
    const int own = dup(STDOUT_FILENO);
    const int nothing = open("/dev/null", O_WRONLY);
    dup2(nothing, STDOUT_FILENO);
    return own >= 0 ? fdopen(own, "wb") : NULL;
}

// Coordinates stay as the file has them: no turn to Assimp's idea of upward, no skeletons.
static const struct aiScene *import(Files *files)
{
    struct aiPropertyStore *settings = aiCreatePropertyStore();
    aiSetImportPropertyInteger(settings, AI_CONFIG_IMPORT_NO_SKELETON_MESHES, 1);
    aiSetImportPropertyInteger(settings, AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, 1);
    const struct aiScene *scene = aiImportFileExWithProperties(files->model, aiProcess_Triangulate,
                                                               &files->interface, settings);
    aiReleasePropertyStore(settings);
    return scene;
}

static bool has_ending(const char *path, const char *ending)
{
    const size_t length = strlen(path), size = strlen(ending);
    return length > size && strcasecmp(path + length - size, ending) == 0;
}

static bool lacks_materials(const Files *files)
{
    for (size_t i = 0; i < files->opened.count; i++)
        if (has_ending(files->opened.data[i].path, ".mtl"))
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
        fprintf(text, "; its materials, %.200s, cannot be opened", files->missing);
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

static bool fail(Error *error)
{
    const char *reason = aiGetErrorString();
    if (strstr(reason, "bad_alloc") != NULL)
        return error_set(error, "Assimp wants more memory to read it than a file of its size may "
                                "take");
    return error_set(error, "Assimp cannot read it: %s",
                     reason[0] != '\0' ? reason : "no reason is given");
}

static bool send_model(FILE *stream, Files *files, Error *error)
{
    PartCounts counts;
    if (!files_open_model(files, error))
        return false;
    const struct aiScene *scene = import(files);
    if (scene == NULL)
        return fail(error);
    send_files(stream, files);
    if (!parts_send(stream, scene, !has_ending(files->model, ".stl"), &counts, error))
        return false;
    if (counts.triangles == 0)
        return error_set(error, "there are no triangles in it");
    send_note(stream, files, &counts);
    send_bytes(stream, FOREIGN_END, "", 0);
    return true;
}

int main(int count, char **words)
{
    Files files;
    Error error = {0};
    if (count != 2)
        return EXIT_FAILURE;
    limits_take();
    FILE *stream = take_output();
    if (stream == NULL)
        return EXIT_FAILURE;
    // With a folder in front, so that side files are looked for in one.
    char *path = file_path_beside("./", words[1], &error);
    if (path == NULL)
        return EXIT_FAILURE;
    files_init(&files, path);
    if (!send_model(stream, &files, &error))
        send_text(stream, FOREIGN_FAILURE, "%s", error.text);
    // The end of the process closes the pipe, and nothing before.
    _exit(fflush(stream) == 0 ? EXIT_SUCCESS : EXIT_FAILURE);
}
