// SPDX-License-Identifier: MIT
// Reads a picture with the module that calls OpenImageIO, and sends it as a StoredImage and its
// values. 8-bit values are converted to float.
#include "foreign/picture.h"

#include "foreign/process_limits.h"
#include "foreign/send.h"
#include "image/image_module.h"

#include <dlfcn.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static void send_values(FILE *stream, const ImageModuleContent *content)
{
    const size_t row = (size_t)content->image.width * content->image.channel_count;
    float *floats = content->is_8_bit ? malloc(row * sizeof *floats) : content->values;
    for (size_t y = 0; floats != NULL && y < content->image.height; y++) {
        if (content->is_8_bit)
            stored_image_values((const unsigned char *)content->values + y * row, row, floats);
        fwrite(content->is_8_bit ? floats : floats + y * row, sizeof *floats, row, stream);
    }
}

static void send_content(FILE *stream, const ImageModuleContent *content)
{
    const StoredImage *image = &content->image;
    const size_t count = (size_t)image->width * image->height * image->channel_count;
    send_head(stream, FOREIGN_PICTURE, 0, sizeof *image + count * sizeof(float));
    fwrite(image, sizeof *image, 1, stream);
    send_values(stream, content);
}

bool picture_send(FILE *stream, char *const words[3], Error *error)
{
    struct stat status;
    char message[512] = "";
    if (stat(words[0], &status) != 0)
        return error_set(error, "%s", strerror(errno));
    limits_take_picture((uint64_t)status.st_size);
    void *module = dlopen(words[2], RTLD_NOW | RTLD_LOCAL);
    ImageModuleRead *read = NULL;
    if (module != NULL)
        *(void **)&read = dlsym(module, IMAGE_MODULE_READ);
    if (read == NULL)
        return error_set(error, "the picture module cannot be opened: %s", dlerror());
    ImageModuleContent content = {.values_max = stored_values_most((uint64_t)status.st_size),
                                  .text_names = stored_text_names};
    if (!read(words[0], words[1], &content, message, sizeof message))
        return error_set(error, "%s", message[0] != '\0' ? message : "it is damaged");
    send_content(stream, &content);
    return true;
}
