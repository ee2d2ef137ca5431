// SPDX-License-Identifier: MIT
// A child process with limited resources reads the file and sends a header and the values, or a
// header with a message. The parent validates the header like a file.
#include "image/image_reader.h"

#include "base/confinement.h"
#include "image/image_module.h"
#include "image/open_module.h"
#include "image/socket.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#define MEMORY_LIMIT ((rlim_t)12 << 30) // bytes beyond the memory already mapped
#define TIME_LIMIT   120                // seconds of processor and of wall time

typedef struct {
    int ok;
    char message[512];
    uint32_t width, height, channel_count, is_8_bit;
    char names[STORED_CHANNELS_MAX][STORED_NAME_SIZE];
    char texts[STORED_TEXTS][STORED_TEXT_SIZE];
} Head;

_Static_assert(STORED_CHANNELS_MAX == IMAGE_MODULE_CHANNELS &&
                   STORED_NAME_SIZE == IMAGE_MODULE_NAME_SIZE &&
                   STORED_TEXTS == IMAGE_MODULE_TEXTS && STORED_TEXT_SIZE == IMAGE_MODULE_TEXT_SIZE,
               "names and texts are copied whole");

static void live_within_limits(void)
{
    confine_process(TIME_LIMIT);
    confine_resource(RLIMIT_AS, confine_mapped_memory() + MEMORY_LIMIT);
    const int nothing = open("/dev/null", O_RDWR);
    for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; stream++)
        dup2(nothing, stream);
}

static void fill_head(Head *head, const ImageModuleContent *content)
{
    head->width = content->width;
    head->height = content->height;
    head->channel_count = content->channel_count;
    head->is_8_bit = content->is_8_bit != 0;
    memcpy(head->names, content->names, sizeof head->names);
    memcpy(head->texts, content->texts, sizeof head->texts);
}

static size_t value_count(const Head *head)
{
    return (size_t)head->width * head->height * head->channel_count;
}

static _Noreturn void serve(int socket, const char *path, const char *format)
{
    Error failure = {0};
    Head head = {0};
    ImageModuleContent content = {.values_max = STORED_VALUES_MAX, .text_names = stored_text_names};
    live_within_limits();
    ImageModuleRead *read = (ImageModuleRead *)open_module(IMAGE_MODULE_READ, &failure);
    snprintf(head.message, sizeof head.message, "%.500s", failure.text);
    head.ok = read != NULL && read(path, format, &content, head.message, sizeof head.message);
    if (head.ok)
        fill_head(&head, &content);
    const size_t size = head.is_8_bit ? 1 : sizeof(float);
    if (socket_send(socket, &head, sizeof head) && head.ok)
        socket_send(socket, content.values, value_count(&head) * size);
    _exit(0);
}

// Messages may quote a hostile file, so control characters become spaces.
static bool take_message(const Head *head, Error *cause)
{
    char message[sizeof head->message];
    snprintf(message, sizeof message, "%.*s", (int)sizeof message - 1, head->message);
    for (char *c = message; *c != '\0'; c++)
        if (*c < ' ' || *c == 127)
            *c = ' ';
    return error_set(cause, "%s", message[0] != '\0' ? message : "it is damaged");
}

// Checks every field before use.
static bool take_head(StoredImage *image, const Head *head, Error *cause)
{
    if (!head->ok)
        return take_message(head, cause);
    if (!stored_image_check_size(head->width, head->height, head->channel_count, cause))
        return false;
    *image = (StoredImage){
        .width = head->width, .height = head->height, .channel_count = head->channel_count};
    memcpy(image->names, head->names, sizeof image->names);
    memcpy(image->texts, head->texts, sizeof image->texts);
    for (uint32_t i = 0; i < STORED_CHANNELS_MAX; i++)
        image->names[i][STORED_NAME_SIZE - 1] = '\0';
    for (int i = 0; i < STORED_TEXTS; i++)
        image->texts[i][STORED_TEXT_SIZE - 1] = '\0';
    return stored_image_allocate(image, cause);
}

static bool take_values(StoredImage *image, int socket, bool is_8_bit, Error *cause)
{
    const size_t count = (size_t)image->width * image->height * image->channel_count;
    if (!is_8_bit)
        return socket_receive(socket, image->values, count * sizeof(float)) ||
               error_set(cause, "reading it ended the process that did");
    unsigned char *bytes = memory_raw(count, 1, cause);
    if (bytes == NULL)
        return false;
    const bool ok = socket_receive(socket, bytes, count);
    if (ok)
        stored_image_values(bytes, count, image->values);
    free(bytes);
    return ok || error_set(cause, "reading it ended the process that did");
}

static bool receive_image(StoredImage *image, int socket, Error *cause)
{
    Head head;
    if (!socket_receive(socket, &head, sizeof head))
        return error_set(cause, "reading it ended the process that did");
    return take_head(image, &head, cause) && take_values(image, socket, head.is_8_bit != 0, cause);
}

bool image_reader_run(StoredImage *image, const char *path, const char *format, Error *cause)
{
    int sockets[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets) != 0)
        return error_set(cause, "no sockets are left");
    const pid_t child = fork();
    if (child == 0) {
        close(sockets[0]);
        serve(sockets[1], path, format);
    }
    close(sockets[1]);
    const bool ok = child > 0 ? receive_image(image, sockets[0], cause)
                              : error_set(cause, "no process can be started");
    close(sockets[0]);
    if (child > 0)
        waitpid(child, NULL, 0);
    return ok;
}
