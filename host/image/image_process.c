// SPDX-License-Identifier: MIT
// The parent sends a request with strings and pixels over a socket pair, and the child answers. The
// parent writes pictures above LARGEST_SENT itself, to avoid a second copy.
#include "image/image_process.h"

#include "base/array.h"
#include "base/child_process.h"

#include <dlfcn.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LARGEST_SENT ((size_t)64 << 20)

// In the socket, zero-terminated strings, the pixels, the layers and the tiles follow the request.
typedef struct {
    uint64_t width, height, frames, is_float, text_count;
    uint64_t tile_width, tile_height, tile_count, is_part;
    uint64_t left, top, whole_width, whole_height;
    uint64_t string_size, pixel_size;
    uint64_t layer_count, layer_size;
    int32_t layer_is_integer[IMAGE_MODULE_LAYERS];
} Request;

typedef struct {
    int ok;
    char message[512];
} Answer;

static ChildProcess writer;

ModuleFunction *open_module(const char *name, Error *cause)
{
    char path[COMPANION_PATH_SIZE];
    if (!file_companion(path, CLRT_IMAGE_MODULE, CLRT_IMAGE_MODULE_FOLDER)) {
        error_set(cause, "the picture module cannot be found: /proc does not show where clrt is");
        return NULL;
    }
    void *module = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    ModuleFunction *function = NULL;
    if (module != NULL)
        *(void **)&function = dlsym(module, name);
    if (function == NULL)
        error_set(cause, "the picture module cannot be opened: %s", dlerror());
    return function;
}

static size_t smaller(int a, int b)
{
    return (size_t)(a < b ? a : b);
}

static size_t pixel_count(const ImageModulePicture *picture)
{
    if (!picture->is_part)
        return (size_t)picture->width * (size_t)picture->height;
    return picture->tile_count * smaller(picture->tile_width, picture->width) *
           smaller(picture->tile_height, picture->height);
}

static size_t pixel_size(const ImageModulePicture *picture)
{
    return pixel_count(picture) * 3 * (picture->is_float ? sizeof(float) : 1);
}

static size_t layer_size(const ImageModulePicture *picture)
{
    return pixel_count(picture) * picture->layer_count * sizeof(uint32_t);
}

static size_t tiles_size(const ImageModulePicture *picture)
{
    return picture->tile_count * 2 * sizeof *picture->tiles;
}

// Returns the number of strings in a request: path, format, texts and layer names, in this order.
static size_t string_count(const ImageModulePicture *picture)
{
    return 2 + 2 * picture->text_count + picture->layer_count;
}

static const char *string_at(const ImageModulePicture *picture, size_t place)
{
    const size_t names = 2 + 2 * picture->text_count;
    if (place >= names)
        return picture->layer_names[place - names];
    return place == 0 ? picture->path : place == 1 ? picture->format : picture->texts[place - 2];
}

static bool send_request(const ImageModulePicture *picture)
{
    Request request = {.width = (uint64_t)picture->width,
                       .height = (uint64_t)picture->height,
                       .frames = (uint64_t)picture->frames,
                       .tile_width = (uint64_t)picture->tile_width,
                       .tile_height = (uint64_t)picture->tile_height,
                       .tile_count = picture->tile_count,
                       .is_part = picture->is_part != 0,
                       .left = (uint64_t)picture->left,
                       .top = (uint64_t)picture->top,
                       .whole_width = (uint64_t)picture->whole_width,
                       .whole_height = (uint64_t)picture->whole_height,
                       .is_float = picture->is_float != 0,
                       .text_count = picture->text_count,
                       .pixel_size = pixel_size(picture),
                       .layer_count = picture->layer_count,
                       .layer_size = layer_size(picture)};
    for (size_t i = 0; i < picture->layer_count; i++)
        request.layer_is_integer[i] = picture->layer_is_integer[i];
    for (size_t i = 0; i < string_count(picture); i++)
        request.string_size += strlen(string_at(picture, i)) + 1;
    bool ok = child_send(writer.socket, &request, sizeof request);
    for (size_t i = 0; ok && i < string_count(picture); i++)
        ok = child_send(writer.socket, string_at(picture, i), strlen(string_at(picture, i)) + 1);
    return ok && child_send(writer.socket, picture->pixels, request.pixel_size) &&
           child_send(writer.socket, picture->layers, request.layer_size) &&
           child_send(writer.socket, picture->tiles, tiles_size(picture));
}

// Points the picture's members into strings. texts must have 2 * text_count entries.
static void place_strings(ImageModulePicture *picture, const char *strings, const char **texts)
{
    picture->path = strings;
    picture->format = picture->path + strlen(picture->path) + 1;
    const char *next = picture->format + strlen(picture->format) + 1;
    for (size_t i = 0; i < 2 * picture->text_count; i++) {
        texts[i] = next;
        next += strlen(next) + 1;
    }
    picture->texts = texts;
    for (size_t i = 0; i < picture->layer_count; i++) {
        picture->layer_names[i] = next;
        next += strlen(next) + 1;
    }
}

static ImageModulePicture picture_of(const Request *request)
{
    ImageModulePicture picture = {.width = (int)request->width,
                                  .height = (int)request->height,
                                  .frames = (int)request->frames,
                                  .tile_width = (int)request->tile_width,
                                  .tile_height = (int)request->tile_height,
                                  .tile_count = request->tile_count,
                                  .is_part = request->is_part != 0,
                                  .left = (int)request->left,
                                  .top = (int)request->top,
                                  .whole_width = (int)request->whole_width,
                                  .whole_height = (int)request->whole_height,
                                  .is_float = request->is_float != 0,
                                  .text_count = request->text_count,
                                  .layer_count = request->layer_count};
    for (size_t i = 0; i < request->layer_count; i++)
        picture.layer_is_integer[i] = request->layer_is_integer[i];
    return picture;
}

static bool answer_request(int socket, const Request *request, ImageModuleWrite *write,
                           const Error *failure)
{
    Error error = {0};
    Answer answer = {0};
    ImageModulePicture picture = picture_of(request);
    char *strings = memory_raw(request->string_size, 1, &error);
    void *pixels = memory_raw(request->pixel_size, 1, &error);
    void *layers = memory_raw(request->layer_size, 1, &error);
    uint32_t *tiles = memory_raw(tiles_size(&picture), 1, &error);
    const char **texts = memory_raw(2 * picture.text_count, sizeof *texts, &error);
    const bool held =
        strings != NULL && pixels != NULL && layers != NULL && tiles != NULL && texts != NULL;
    bool ok = held && child_receive(socket, strings, request->string_size) &&
              child_receive(socket, pixels, request->pixel_size) &&
              child_receive(socket, layers, request->layer_size) &&
              child_receive(socket, tiles, tiles_size(&picture));
    if (ok) {
        place_strings(&picture, strings, texts);
        picture.pixels = pixels;
        picture.layers = layers;
        picture.tiles = tiles;
        snprintf(answer.message, sizeof answer.message, "%.500s", failure->text);
        answer.ok = write != NULL && write(&picture, answer.message, sizeof answer.message);
        ok = child_send(socket, &answer, sizeof answer);
    }
    free(strings);
    free(pixels);
    free(layers);
    free(tiles);
    free(texts);
    return ok;
}

// Serves requests until the parent ends.
static void serve(int socket, const void *context)
{
    Error failure = {0};
    Request request;
    (void)context;
    // Only the parent handles these signals. It may still send its picture afterwards.
    signal(SIGINT, SIG_IGN);
    signal(SIGTERM, SIG_IGN);
    ImageModuleWrite *write = (ImageModuleWrite *)open_module(IMAGE_MODULE_WRITE, &failure);
    while (child_receive(socket, &request, sizeof request) &&
           answer_request(socket, &request, write, &failure))
        continue;
}

void image_process_start(void)
{
    Error ignored = {0};
    if (writer.id == 0)
        child_fork(&writer, serve, NULL, &ignored);
}

static bool write_here(const ImageModulePicture *picture, Error *cause)
{
    char message[512] = "";
    ImageModuleWrite *write = (ImageModuleWrite *)open_module(IMAGE_MODULE_WRITE, cause);
    return write != NULL &&
           (write(picture, message, sizeof message) || error_set(cause, "%s", message));
}

bool image_process_write(const ImageModulePicture *picture, Error *cause)
{
    Answer answer;
    if (writer.id == 0 || pixel_size(picture) + layer_size(picture) > LARGEST_SENT)
        return write_here(picture, cause);
    if (!send_request(picture) || !child_receive(writer.socket, &answer, sizeof answer))
        return error_set(cause, "the process that writes pictures has ended");
    return answer.ok || error_set(cause, "%s", answer.message);
}
