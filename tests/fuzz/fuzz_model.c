// SPDX-License-Identifier: MIT
// libFuzzer target: reads any bytes as a model with Assimp, like clrt-foreign without its process
// limits. The first byte selects the format. The result must be a valid stream or a message.
// Crashes in Assimp are not findings, because clrt expects them.
#include "demand.h"

#include "foreign/model.h"
#include "mesh/foreign_stream.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static const char *const names[] = {"./m.obj", "./m.stl", "./m.glb",  "./m.gltf", "./m.off",
                                    "./m.dae", "./m.3ds", "./m.fbx",  "./m.x",    "./m.x3d",
                                    "./m.ac",  "./m.dxf", "./m.3mf",  "./m.lwo",  "./m.nff",
                                    "./m.raw", "./m.smd", "./m.ms3d", "./m.amf",  "./m.md2"};

static void open_bytes(Files *files, const uint8_t *data, size_t size)
{
    Error error = {0};
    OpenedFile model = {.path = strdup(files->model), .file = {malloc(size + 1), size}};
    demand(model.path != NULL && model.file.bytes != NULL);
    memcpy(model.file.bytes, data, size);
    model.file.bytes[size] = '\0';
    demand(array_push(&files->opened, model, &error));
}

static void close_files(Files *files)
{
    for (size_t i = 0; i < files->opened.count; i++) {
        free(files->opened.data[i].path);
        file_free(&files->opened.data[i].file);
    }
    free(files->opened.memory);
}

static void read_back(const File *stream)
{
    ForeignModel model;
    Error error = {0};
    const bool is_read = foreign_stream_parse(&model, stream, "m", false, &error);
    demand(is_read ? model.parts.count > 0 && model.files.count > 0 : error.text[0] != '\0');
    foreign_model_free(&model);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    Files files;
    Error error = {0};
    char *bytes = NULL;
    size_t sent = 0;
    if (size == 0)
        return 0;
    files_init(&files, names[data[0] % (sizeof names / sizeof *names)]);
    open_bytes(&files, data + 1, size - 1);
    FILE *stream = open_memstream(&bytes, &sent);
    demand(stream != NULL);
    const bool ok = model_send(stream, &files, &error);
    demand(fclose(stream) == 0 && ok == (error.text[0] == '\0'));
    if (ok)
        read_back(&(File){bytes, sent});
    free(bytes);
    close_files(&files);
    return 0;
}
