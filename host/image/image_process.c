// SPDX-License-Identifier: MIT
// Runs clrt-foreign, which reads a file with OpenImageIO. clrt-foreign sends a picture or a
// message, and the code here validates both.
#include "image/image_process.h"

#include "base/foreign.h"

#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>

static bool find_module(char path[COMPANION_PATH_SIZE], Error *cause)
{
    return foreign_companion(path, CLRT_IMAGE_MODULE,
                             CLRT_IMAGE_MODULE_FOLDER "/" CLRT_IMAGE_MODULE) ||
           error_set(cause, "the picture module %s cannot be found", CLRT_IMAGE_MODULE);
}

ModuleFunction *open_module(const char *name, Error *cause)
{
    char path[COMPANION_PATH_SIZE];
    if (!find_module(path, cause))
        return NULL;
    void *module = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    ModuleFunction *function = NULL;
    if (module != NULL)
        *(void **)&function = dlsym(module, name);
    if (function == NULL)
        error_set(cause, "the picture module cannot be opened: %s", dlerror());
    return function;
}

static bool take_failure(File *stream, const ForeignHead *head, Error *cause)
{
    char *text = stream->bytes + sizeof *head;
    foreign_make_printable(text, head->size, '?');
    return error_set(cause, "%.*s", (int)head->size, text);
}

static bool take_head(StoredImage *image, const File *stream, uint64_t most, Error *cause)
{
    memcpy(image, stream->bytes + sizeof(ForeignHead), sizeof *image);
    image->values = NULL;
    for (uint32_t i = 0; i < STORED_CHANNELS_MAX; i++)
        image->names[i][STORED_NAME_SIZE - 1] = '\0';
    for (int i = 0; i < STORED_TEXTS; i++)
        image->texts[i][STORED_TEXT_SIZE - 1] = '\0';
    return stored_image_check_size(image, most, cause);
}

// Moves the values to the start of the stream's memory, and gives that memory to the image.
static void take_values(StoredImage *image, File *stream, size_t size)
{
    memmove(stream->bytes, stream->bytes + stream->size - size, size);
    void *values = realloc(stream->bytes, size);
    image->values = values != NULL ? values : (void *)stream->bytes;
    *stream = (File){0};
}

static bool take_picture(StoredImage *image, File *stream, uint64_t most, Error *cause)
{
    ForeignHead head = {0};
    if (stream->size >= sizeof head)
        memcpy(&head, stream->bytes, sizeof head);
    const bool is_whole = head.size == stream->size - sizeof head;
    if (is_whole && head.kind == FOREIGN_FAILURE && head.size < sizeof cause->text)
        return take_failure(stream, &head, cause);
    if (is_whole && head.kind == FOREIGN_PICTURE && head.size > sizeof *image) {
        if (!take_head(image, stream, most, cause))
            return false;
        const size_t size =
            (size_t)image->width * image->height * image->channel_count * sizeof(float);
        if (size == head.size - sizeof *image) {
            take_values(image, stream, size);
            return true;
        }
    }
    return error_set(cause, "the output of clrt-foreign, which reads it, is damaged");
}

bool image_process_read(StoredImage *image, const ImageRequest *request, Error *cause)
{
    char module[COMPANION_PATH_SIZE];
    const char *const words[FOREIGN_WORDS] = {request->path, request->format, module};
    const uint64_t most = stored_values_most(request->bytes);
    const size_t heads = sizeof(ForeignHead) + sizeof(StoredImage);
    const ForeignReader reader = {
        .library = "OpenImageIO", .seconds = 125, .bytes = heads + most * sizeof(float)};
    File stream = {0};
    const bool ok = find_module(module, cause) && foreign_run(&stream, &reader, words, cause) &&
                    take_picture(image, &stream, most, cause);
    file_free(&stream);
    return ok;
}
