// SPDX-License-Identifier: MIT
// Selects the writer for a format. A table lists the formats and the sizes that they can store.
#include "image/image_file.h"

#include "base/output_file.h"
#include "image/exr_write.h"
#include "image/image_process.h"
#include "image/pfm.h"
#include "image/png_file.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

// libjpeg ends the process if a side is longer than this.
#define JPEG_SIDE_MAX 65500

// OpenImageIO writes sides longer than this modulo 65536, without an error.
#define GIF_SIDE_MAX 65535

typedef struct {
    const char *name;   // also the usual file extension
    const char *module; // OpenImageIO's name of the format; NULL if clrt writes the format itself
    bool is_float;
    uint32_t side_max; // longest side of a picture, in pixels; 0 if only PICTURE_SIZE_MAX limits it
} Format;

static const Format formats[] = {
    {"png", NULL, false, 0},
    {"pfm", NULL, true, 0},
    {"exr", NULL, true, 0},
#ifdef CLRT_WITH_OPENIMAGEIO
    {"jpg", "jpeg", false, JPEG_SIDE_MAX},
    {"jpeg", "jpeg", false, JPEG_SIDE_MAX},
    {"tif", "tiff", false, 0},
    {"tiff", "tiff", false, 0},
    {"ppm", "pnm", false, 0},
    {"hdr", "hdr", true, 0},
    {"gif", "gif", false, GIF_SIDE_MAX},
#endif
};

static const Format *find_format(const char *name)
{
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; i++)
        if (strcasecmp(formats[i].name, name) == 0)
            return &formats[i];
    return NULL;
}

const char *image_format_named(const char *name)
{
    const Format *format = find_format(name);
    return format == NULL ? NULL : format->name;
}

const char *image_format_of_path(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot == NULL || strchr(dot, '/') != NULL ? NULL : image_format_named(dot + 1);
}

bool image_format_is_float(const char *format)
{
    return find_format(format)->is_float;
}

bool image_format_takes_layers(const char *name)
{
    return strcmp(name, "exr") == 0;
}

const char *image_format_names(void)
{
#ifdef CLRT_WITH_OPENIMAGEIO
    return "png, jpg, tif, ppm, exr, hdr, pfm";
#else
    return "png, exr, pfm (more after tools/setup images && tools/render)";
#endif
}

double image_format_half_step(const char *format, Encoding encoding)
{
    const double steepest = encoding == ENCODE_SRGB ? 12.92 : 1; // slope of the curve at black
    return find_format(format)->is_float ? 0x1p-25 : 1 / (510 * steepest);
}

bool image_check_size(const char *format, uint32_t width, uint32_t height, Error *error)
{
    const uint32_t most = find_format(format)->side_max;
    return most == 0 || (width <= most && height <= most) ||
           error_set(error, "a picture in the format %s has at most %u pixels a side", format,
                     most);
}

// Returns a whole picture as width * height * 3 bytes, or NULL. The caller frees the bytes.
static unsigned char *encode_bytes(const Framebuffer *framebuffer, const ImageSettings *settings,
                                   Error *error)
{
    const size_t count = (size_t)framebuffer->width * framebuffer->height;
    unsigned char *bytes = memory_raw(count, 3, error);
    if (bytes != NULL)
        framebuffer_encode(framebuffer->pixels[0], 3 * count, settings->encoding,
                           exp2(settings->exposure), bytes);
    return bytes;
}

// The next two functions store the reason for a failure in *cause. image_write adds the file name.
static bool write_by_module(const Framebuffer *framebuffer, const char *path, const Format *format,
                            const ImageSettings *settings, Error *cause)
{
    char message[512] = "";
    ImageModuleWrite *write = (ImageModuleWrite *)open_module(IMAGE_MODULE_WRITE, cause);
    unsigned char *bytes =
        format->is_float || write == NULL ? NULL : encode_bytes(framebuffer, settings, cause);
    if (write == NULL || (bytes == NULL && !format->is_float))
        return false;
    const ImageModulePicture picture = {
        .path = path,
        .format = format->module,
        .pixels = format->is_float ? (const void *)framebuffer->pixels : bytes,
        .width = (int)framebuffer->width,
        .height = (int)framebuffer->height,
        .frames = (int)settings->frames,
        .is_float = format->is_float,
        .texts = (const char *const *)settings->texts,
        .text_count = settings->text_count,
    };
    const bool ok = write(&picture, message, sizeof message) || error_set(cause, "%s", message);
    free(bytes);
    return ok;
}
_Static_assert(sizeof(ImageText) == 2 * sizeof(char *), "texts are read as pairs of strings");

static bool write_format(const Framebuffer *framebuffer, const char *path,
                         const ImageSettings *settings, Error *cause)
{
    const Format *format = find_format(settings->format);
    if (format->module != NULL)
        return write_by_module(framebuffer, path, format, settings, cause);
    FILE *stream = fopen(path, "wbe");
    if (stream == NULL)
        return error_set(cause, "%s", strerror(errno));
    const bool written = image_format_takes_layers(format->name)
                             ? exr_write(framebuffer, settings, stream, cause)
                         : format->is_float ? pfm_write(framebuffer, stream)
                                            : png_file_write(framebuffer, settings, stream, cause);
    const bool closed = fclose(stream) == 0;
    return (written && closed) || error_set(cause, "%s", strerror(errno));
}

bool image_write(const Framebuffer *framebuffer, const char *path, const ImageSettings *settings,
                 Error *error)
{
    OutputFile file;
    Error cause = {0};
    const uint32_t frames = settings->frames > 0 ? settings->frames : 1;
    if (!image_check_size(settings->format, framebuffer->width, framebuffer->height / frames,
                          error) ||
        !output_file_begin(&file, path, error))
        return false;
    const bool ok = write_format(framebuffer, file.temporary, settings, &cause);
    return output_file_end(&file, ok, &cause) ||
           error_set(error, "%s: cannot be written: %s",
                     strcmp(path, "-") == 0 ? "standard output" : path, cause.text);
}
