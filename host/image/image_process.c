// SPDX-License-Identifier: MIT
// A child process with limited resources reads the file and sends a header and the values, or a
// header with a message. The parent validates every field of the header.
#include "image/image_process.h"

#include "base/child_process.h"
#include "base/processors.h"

#include <dlfcn.h>
#include <malloc.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define MEMORY_LEAST      ((rlim_t)256 << 20) // bytes beyond the memory already mapped
#define MEMORY_PER_THREAD ((rlim_t)16 << 20)  // bytes; mostly stack

// The header that the child sends, followed by the values if ok.
typedef struct {
    int ok;
    char message[512];
    ImageModuleContent content; // its pointers are valid only in the child
} Head;

_Static_assert(STORED_CHANNELS_MAX == IMAGE_MODULE_CHANNELS &&
                   STORED_NAME_SIZE == IMAGE_MODULE_NAME_SIZE &&
                   STORED_TEXTS == IMAGE_MODULE_TEXTS && STORED_TEXT_SIZE == IMAGE_MODULE_TEXT_SIZE,
               "names and texts are copied whole");

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

// Decoders need memory for the values and about as much for themselves. Each thread reserves some.
static void live_within_limits(uint64_t bytes)
{
    const rlim_t values = 2 * sizeof(float) * stored_values_most(bytes);
    confine_process(reader_limits);
    confine_add_time(bytes);
    mallopt(M_ARENA_MAX, 1);
    confine_resource(RLIMIT_AS, confine_mapped_memory() + values +
                                    processors_present() * MEMORY_PER_THREAD + MEMORY_LEAST);
    dup2(STDOUT_FILENO, STDERR_FILENO); // decoders print warnings
}

static void serve(int socket, const void *context)
{
    const ImageRequest *request = context;
    Error failure = {0};
    Head head = {.content = {.values_max = stored_values_most(request->bytes),
                             .text_names = stored_text_names}};
    const ImageModuleContent *content = &head.content;
    live_within_limits(request->bytes);
    ImageModuleRead *read = (ImageModuleRead *)open_module(IMAGE_MODULE_READ, &failure);
    snprintf(head.message, sizeof head.message, "%.500s", failure.text);
    head.ok = read != NULL && read(request->path, request->format, &head.content, head.message,
                                   sizeof head.message);
    if (child_send(socket, &head, sizeof head) && head.ok)
        child_send(socket, content->values,
                   (size_t)content->width * content->height * content->channel_count *
                       (content->is_8_bit ? 1 : sizeof(float)));
}

// Messages may quote a hostile file, so control characters become spaces.
static bool take_message(const Head *head, Error *cause)
{
    char message[sizeof head->message];
    snprintf(message, sizeof message, "%.*s", (int)sizeof message - 1, head->message);
    for (char *c = message; *c != '\0'; c++)
        if ((unsigned char)*c < ' ' || *c == 127)
            *c = ' ';
    return error_set(cause, "%s", message[0] != '\0' ? message : "it is damaged");
}

static bool take_head(StoredImage *image, const Head *head, uint64_t most, Error *cause)
{
    const ImageModuleContent *content = &head->content;
    if (!head->ok)
        return take_message(head, cause);
    *image = (StoredImage){.width = content->width,
                           .height = content->height,
                           .channel_count = content->channel_count};
    memcpy(image->names, content->names, sizeof image->names);
    memcpy(image->texts, content->texts, sizeof image->texts);
    for (uint32_t i = 0; i < STORED_CHANNELS_MAX; i++)
        image->names[i][STORED_NAME_SIZE - 1] = '\0';
    for (int i = 0; i < STORED_TEXTS; i++)
        image->texts[i][STORED_TEXT_SIZE - 1] = '\0';
    return stored_image_check_size(image, most, cause) && stored_image_allocate(image, cause);
}

static bool take_values(StoredImage *image, int socket, bool is_8_bit, Error *cause)
{
    const size_t count = (size_t)image->width * image->height * image->channel_count;
    const size_t size = count * (is_8_bit ? 1 : sizeof(float));
    // Bytes fill the end of the array, so that no byte is overwritten before it is converted.
    unsigned char *bytes = (unsigned char *)(image->values + count) - size;
    if (!child_receive(socket, bytes, size))
        return error_set(cause, "the process that reads it ended too early");
    if (is_8_bit)
        stored_image_values(bytes, count, image->values);
    return true;
}

static bool receive_image(StoredImage *image, int socket, uint64_t most, Error *cause)
{
    Head head;
    if (!child_receive(socket, &head, sizeof head))
        return error_set(cause, "the process that reads it ended too early");
    return take_head(image, &head, most, cause) &&
           take_values(image, socket, head.content.is_8_bit != 0, cause);
}

bool image_process_read(StoredImage *image, const ImageRequest *request, Error *cause)
{
    ChildProcess child;
    if (!child_fork(&child, serve, request, cause))
        return false;
    const bool ok = receive_image(image, child.socket, stored_values_most(request->bytes), cause);
    child_end(&child);
    return ok;
}
