// SPDX-License-Identifier: MIT
// The program clrt-foreign. `clrt-foreign MODEL` reads a model with Assimp. `clrt-foreign PICTURE
// FORMAT MODULE` reads a picture with OpenImageIO. Both write records (base/foreign.h) to standard
// output. The 8-bit values of a picture become floats. Only clrt and its library run this program.
#include "foreign/process_limits.h"
#include "foreign/send.h"
#include "image/image_module.h"

#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#ifdef CLRT_WITH_ASSIMP
#include "foreign/model.h"

// Sends the model. Puts "./" in front of a relative path, so that Assimp searches the model's
// folder for the other files of the model.
static bool send_model(FILE *stream, const char *name, Error *error)
{
    Files files;
    char *path = file_path_beside("./", name, error);
    if (path == NULL)
        return false;
    process_limits_take_model();
    files_init(&files, path);
    return model_send(stream, &files, error);
}
#else
static bool send_model(FILE *stream, const char *name, Error *error)
{
    (void)stream, (void)name;
    return error_set(error, "this build reads only PLY meshes, because it lacks Assimp; add it: "
                            "tools/setup meshes && tools/render SCENE");
}
#endif

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

// Sends a record FOREIGN_PICTURE. `words` holds the file's path, the name of its format in
// OpenImageIO, and the path of the module that calls OpenImageIO. Returns false and stores the
// reason if the file cannot be read.
static bool send_picture(FILE *stream, char *const words[3], Error *error)
{
    struct stat status;
    char message[512] = "";
    if (stat(words[0], &status) != 0)
        return error_set(error, "%s", strerror(errno));
    process_limits_take_picture((uint64_t)status.st_size);
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

// Redirects standard output to /dev/null, because importers print to it. Returns a stream for the
// original standard output.
static FILE *take_output(void)
{
    const int own = dup(STDOUT_FILENO);
    const int nothing = open("/dev/null", O_WRONLY);
    dup2(nothing, STDOUT_FILENO);
    return own >= 0 ? fdopen(own, "wb") : NULL;
}

int main(int count, char **arguments)
{
    Error error = {0};
    process_limits_take();
    FILE *stream = take_output();
    if (stream == NULL || (count != 2 && count != 4))
        return EXIT_FAILURE;
    if (count == 2 ? !send_model(stream, arguments[1], &error)
                   : !send_picture(stream, arguments + 1, &error))
        send_text(stream, FOREIGN_FAILURE, "%s", error.text);
    // The end of the process closes the stream.
    _exit(fflush(stream) == 0 ? EXIT_SUCCESS : EXIT_FAILURE);
}
