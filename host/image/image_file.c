// SPDX-License-Identifier: MIT
// Chooses the writer by format and moves the finished file into its place.
#include "image/image_file.h"

#include "image/encode.h"
#include "image/image_process.h"
#include "image/pfm.h"
#include "image/png_file.h"

#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

// libjpeg ends the process past it.
#define JPEG_SIZE_MAX 65500

typedef struct {
    const char *name;   // also the usual ending
    const char *module; // OpenImageIO's name; NULL for what is written here
    bool is_float;
} Format;

static const Format formats[] = {
    {"png", NULL, false},    {"pfm", NULL, true},
#ifdef CLRT_WITH_OPENIMAGEIO
    {"jpg", "jpeg", false},  {"jpeg", "jpeg", false}, {"tif", "tiff", false},
    {"tiff", "tiff", false}, {"ppm", "pnm", false},   {"exr", "openexr", true},
    {"hdr", "hdr", true},
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
    return "png, pfm";
#endif
}

double image_format_half_step(const char *format, Encoding encoding)
{
    const double steepest = encoding == ENCODE_SRGB ? 12.92 : 1; // of the curve, at black
    return find_format(format)->is_float ? 0x1p-25 : 1 / (510 * steepest);
}

void image_prepare(const char *format)
{
    if (find_format(format)->module != NULL)
        image_process_start();
}

static bool is_replaceable(const char *path)
{
    struct stat status;
    return strcmp(path, "-") != 0 && (lstat(path, &status) != 0 || S_ISREG(status.st_mode));
}

// Makes an empty file for the unfinished picture, in the folder of path, so that it can be renamed
// to it, or among the system's temporary files, and returns its name.
static char *temporary_file(const char *path, bool beside, Error *error)
{
    const char *slash = strrchr(path, '/');
    const char *system = getenv("TMPDIR");
    const char *folder = system != NULL && system[0] == '/' ? system : "/tmp";
    const size_t length = slash == NULL ? 0 : (size_t)(slash - path) + 1;
    const size_t size = strlen(path) + strlen(folder) + 32;
    char *name = memory_raw(size, 1, error);
    if (name == NULL)
        return NULL;
    if (beside)
        snprintf(name, size, "%.*s.clrt-XXXXXX", (int)length, path);
    else
        snprintf(name, size, "%s/clrt-XXXXXX", folder);
    const int file = mkstemp(name);
    if (file >= 0) {
        const mode_t mask = umask(0);
        umask(mask);
        fchmod(file, 0666 & ~mask);
        close(file);
        return name;
    }
    error_set(error, "%s: cannot be written: %s", path, strerror(errno));
    free(name);
    return NULL;
}

bool image_check_path(const char *path, Error *error)
{
    struct stat status;
    const bool exists = stat(path, &status) == 0;
    if (path[strlen(path) - 1] == '/' || (exists && S_ISDIR(status.st_mode)))
        return error_set(error, "%s: cannot be written: it is a folder", path);
    if (!is_replaceable(path)) {
        const bool writable = strcmp(path, "-") == 0 || access(path, W_OK) == 0;
        return writable || error_set(error, "%s: cannot be written: %s", path, strerror(errno));
    }
    char *temporary = temporary_file(path, true, error);
    if (temporary == NULL)
        return false;
    unlink(temporary);
    free(temporary);
    return strlen(strrchr(path, '/') != NULL ? strrchr(path, '/') + 1 : path) <= NAME_MAX ||
           error_set(error, "%s: cannot be written: the name is too long", path);
}

bool image_check_size(const char *format, uint32_t width, uint32_t height, Error *error)
{
    const char *module = find_format(format)->module;
    const bool is_jpeg = module != NULL && strcmp(module, "jpeg") == 0;
    return !is_jpeg || (width <= JPEG_SIZE_MAX && height <= JPEG_SIZE_MAX) ||
           error_set(error, "a JPEG has at most %d pixels a side", JPEG_SIZE_MAX);
}

static void place_layers(ImageModulePicture *picture, const Layers *layers)
{
    picture->layers = layers->values;
    picture->layer_count = layers->count;
    for (uint32_t layer = 0; layer < layers->count; layer++) {
        picture->layer_names[layer] = layers->list[layer].name;
        picture->layer_is_integer[layer] = layers->list[layer].is_integer;
    }
}

// These name the reason alone; image_write names the picture.
static bool write_by_module(const Framebuffer *framebuffer, const char *path, const Format *format,
                            const ImageSettings *settings, Error *cause)
{
    unsigned char *bytes = NULL;
    if (!format->is_float) {
        bytes = encode_bytes(framebuffer, settings->encoding, cause);
        if (bytes == NULL)
            return false;
    }
    ImageModulePicture picture = {
        .path = path,
        .format = format->module,
        .pixels = format->is_float ? (const void *)framebuffer->pixels : bytes,
        .width = (int)framebuffer->width,
        .height = (int)framebuffer->height,
        .is_float = format->is_float,
        .texts = (const char *const *)settings->texts,
        .text_count = settings->text_count,
    };
    if (settings->layers != NULL)
        place_layers(&picture, settings->layers);
    const bool ok = image_process_write(&picture, cause);
    free(bytes);
    return ok;
}
_Static_assert(sizeof(ImageText) == 2 * sizeof(char *), "texts are read as pairs of strings");

static bool write_here(const Framebuffer *framebuffer, const char *path, const Format *format,
                       const ImageSettings *settings, Error *cause)
{
    FILE *stream = fopen(path, "wb");
    if (stream == NULL)
        return error_set(cause, "%s", strerror(errno));
    const bool written = format->is_float ? pfm_write(framebuffer, stream)
                                          : png_file_write(framebuffer, settings, stream, cause);
    const bool closed = fclose(stream) == 0;
    return (written && closed) || error_set(cause, "%s", strerror(errno));
}

static bool write_format(const Framebuffer *framebuffer, const char *path,
                         const ImageSettings *settings, Error *cause)
{
    const Format *format = find_format(settings->format);
    if (format->module == NULL)
        return write_here(framebuffer, path, format, settings, cause);
    return write_by_module(framebuffer, path, format, settings, cause);
}

static bool copy_stream(FILE *from, FILE *to)
{
    char block[65536];
    size_t count;
    while ((count = fread(block, 1, sizeof block, from)) > 0)
        if (fwrite(block, 1, count, to) != count)
            return false;
    return !ferror(from) && fflush(to) == 0;
}

// Pipes and devices cannot be replaced by a file: the finished bytes are copied into them.
static bool copy_file(const char *from, const char *path, Error *cause)
{
    const bool standard = strcmp(path, "-") == 0;
    FILE *source = fopen(from, "rb");
    FILE *target = standard ? stdout : fopen(path, "wb");
    // Gone by name already, so that nothing is left of it if the process is ended here.
    unlink(from);
    const bool ok = source != NULL && target != NULL && copy_stream(source, target);
    if (!ok)
        error_set(cause, "%s", strerror(errno));
    if (source != NULL)
        fclose(source);
    if (target != NULL && !standard)
        fclose(target);
    return ok;
}

bool image_write(const Framebuffer *framebuffer, const char *path, const ImageSettings *settings,
                 Error *error)
{
    const bool replaceable = is_replaceable(path);
    char *temporary = temporary_file(path, replaceable, error);
    if (temporary == NULL)
        return false;
    Error cause = {0};
    bool ok = write_format(framebuffer, temporary, settings, &cause);
    if (ok && !replaceable)
        ok = copy_file(temporary, path, &cause);
    if (ok && replaceable && rename(temporary, path) != 0)
        ok = error_set(&cause, "%s", strerror(errno));
    if (!ok) {
        unlink(temporary);
        error_set(error, "%s: cannot be written: %s",
                  strcmp(path, "-") == 0 ? "standard output" : path, cause.text);
    }
    free(temporary);
    return ok;
}
