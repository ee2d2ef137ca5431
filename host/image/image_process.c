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

// In the socket, zero-terminated strings and the pixels follow the request.
typedef struct {
    ImageModulePicture picture; // whose pointers are the parent's
    size_t string_size;
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

static size_t pixel_size(const ImageModulePicture *picture)
{
    return (size_t)picture->width * (size_t)picture->height * 3 *
           (picture->is_float ? sizeof(float) : 1);
}

// Returns a string of a request: path, format, or one of 2 * text_count texts.
static const char *string_at(const ImageModulePicture *picture, size_t place)
{
    return place == 0 ? picture->path : place == 1 ? picture->format : picture->texts[place - 2];
}

static bool send_request(const ImageModulePicture *picture)
{
    Request request = {.picture = *picture};
    const size_t count = 2 + 2 * picture->text_count;
    for (size_t i = 0; i < count; i++)
        request.string_size += strlen(string_at(picture, i)) + 1;
    bool ok = child_send(writer.socket, &request, sizeof request);
    for (size_t i = 0; ok && i < count; i++)
        ok = child_send(writer.socket, string_at(picture, i), strlen(string_at(picture, i)) + 1);
    return ok && child_send(writer.socket, picture->pixels, pixel_size(picture));
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
}

static bool answer_request(int socket, const Request *request, ImageModuleWrite *write,
                           const Error *failure)
{
    Error error = {0};
    Answer answer = {0};
    ImageModulePicture picture = request->picture;
    char *strings = memory_raw(request->string_size, 1, &error);
    void *pixels = memory_raw(pixel_size(&picture), 1, &error);
    const char **texts = memory_raw(2 * picture.text_count, sizeof *texts, &error);
    bool ok = strings != NULL && pixels != NULL && texts != NULL &&
              child_receive(socket, strings, request->string_size) &&
              child_receive(socket, pixels, pixel_size(&picture));
    if (ok) {
        place_strings(&picture, strings, texts);
        picture.pixels = pixels;
        snprintf(answer.message, sizeof answer.message, "%.500s", failure->text);
        answer.ok = write != NULL && write(&picture, answer.message, sizeof answer.message);
        ok = child_send(socket, &answer, sizeof answer);
    }
    free(strings);
    free(pixels);
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
    if (writer.id == 0 || pixel_size(picture) > LARGEST_SENT)
        return write_here(picture, cause);
    if (!send_request(picture) || !child_receive(writer.socket, &answer, sizeof answer))
        return error_set(cause, "the process that writes pictures has ended");
    return answer.ok || error_set(cause, "%s", answer.message);
}
