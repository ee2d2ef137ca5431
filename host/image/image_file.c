// SPDX-License-Identifier: MIT
// Chooses the writer by format and moves the finished file into its place.
#include "image/image_file.h"

#include "image/encode.h"
#include "image/image_loader.h"
#include "image/pfm.h"

#include <errno.h>
#include <libgen.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

typedef struct {
    const char *name;   // also the usual ending
    const char *module; // OpenImageIO's name; NULL for our own writer
    bool is_float;
} Format;

static const Format formats[] = {
    {"pfm", NULL, true},
#ifdef CLRT_WITH_OPENIMAGEIO
    {"png", "png", false},    {"jpg", "jpeg", false},  {"jpeg", "jpeg", false},
    {"tif", "tiff", false},   {"tiff", "tiff", false}, {"ppm", "pnm", false},
    {"exr", "openexr", true}, {"hdr", "hdr", true},
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

const char *image_format_names(void)
{
#ifdef CLRT_WITH_OPENIMAGEIO
    return "png, jpg, tif, ppm, exr, hdr, pfm";
#else
    return "pfm";
#endif
}

void image_prepare(const char *format)
{
    if (find_format(format)->module != NULL)
        image_loader_start();
}

bool image_check_path(const char *path, Error *error)
{
    struct stat status;
    if (strcmp(path, "-") == 0)
        return true;
    if (stat(path, &status) == 0) {
        if (S_ISDIR(status.st_mode))
            return error_set(error, "%s: cannot be written: it is a folder", path);
        return access(path, W_OK) == 0 ||
               error_set(error, "%s: cannot be written: %s", path, strerror(errno));
    }
    char *copy = strdup(path);
    if (copy == NULL)
        return error_out_of_memory(error, strlen(path));
    const bool writable = access(dirname(copy), W_OK | X_OK) == 0;
    free(copy);
    return writable || error_set(error, "%s: cannot be written: %s", path, strerror(errno));
}

static bool write_by_module(const Framebuffer *framebuffer, const char *path, const Format *format,
                            const ImageSettings *settings, Error *error)
{
    ImageModuleWrite *write = image_loader_finish(error);
    unsigned char *bytes = NULL;
    if (write == NULL)
        return false;
    if (!format->is_float) {
        bytes = encode_bytes(framebuffer, settings->encoding, error);
        if (bytes == NULL)
            return false;
    }
    char message[512] = "";
    const ImageModulePicture picture = {
        .path = path,
        .format = format->module,
        .pixels = format->is_float ? (const void *)framebuffer->pixels : bytes,
        .width = (int)framebuffer->width,
        .height = (int)framebuffer->height,
        .is_float = format->is_float,
        .texts = (const char *const *)settings->texts,
        .text_count = settings->text_count,
    };
    const bool ok = write(&picture, message, sizeof message);
    free(bytes);
    return ok || error_set(error, "%s: cannot be written: %s", path, message);
}
_Static_assert(sizeof(ImageText) == 2 * sizeof(char *), "texts are read as pairs of strings");

static bool write_pfm(const Framebuffer *framebuffer, const char *path, Error *error)
{
    FILE *stream = fopen(path, "wb");
    if (stream == NULL)
        return error_set(error, "%s: cannot be written: %s", path, strerror(errno));
    const bool written = pfm_write(framebuffer, stream);
    const bool closed = fclose(stream) == 0;
    return (written && closed) ||
           error_set(error, "%s: cannot be written: %s", path, strerror(errno));
}

static bool write_format(const Framebuffer *framebuffer, const char *path,
                         const ImageSettings *settings, Error *error)
{
    const Format *format = find_format(settings->format);
    if (format->module == NULL)
        return write_pfm(framebuffer, path, error);
    return write_by_module(framebuffer, path, format, settings, error);
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
static bool copy_file(const char *from, const char *path, Error *error)
{
    const bool standard = strcmp(path, "-") == 0;
    FILE *source = fopen(from, "rb");
    FILE *target = standard ? stdout : fopen(path, "wb");
    const bool ok = source != NULL && target != NULL && copy_stream(source, target);
    if (!ok)
        error_set(error, "%s: cannot be written: %s", standard ? "standard output" : path,
                  strerror(errno));
    if (source != NULL)
        fclose(source);
    if (target != NULL && !standard)
        fclose(target);
    return ok;
}

static bool is_replaceable(const char *path)
{
    struct stat status;
    return strcmp(path, "-") != 0 && (lstat(path, &status) != 0 || S_ISREG(status.st_mode));
}

// A name for the unfinished file: beside its final place, so that it can be renamed into it.
static char *temporary_name(const char *path, bool beside, Error *error)
{
    const char *folder = getenv("TMPDIR");
    if (folder == NULL || folder[0] != '/')
        folder = "/tmp";
    const size_t size = strlen(path) + strlen(folder) + 32;
    char *name = memory_raw(size, 1, error);
    if (name == NULL)
        return NULL;
    if (beside)
        snprintf(name, size, "%s.XXXXXX", path);
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
    error_set(error, "%s: cannot be written: %s", name, strerror(errno));
    free(name);
    return NULL;
}

bool image_write(const Framebuffer *framebuffer, const char *path, const ImageSettings *settings,
                 Error *error)
{
    const bool replaceable = is_replaceable(path);
    char *temporary = temporary_name(path, replaceable, error);
    if (temporary == NULL)
        return false;
    bool ok = write_format(framebuffer, temporary, settings, error);
    if (ok && !replaceable)
        ok = copy_file(temporary, path, error);
    if (ok && replaceable && rename(temporary, path) != 0)
        ok = error_set(error, "%s: cannot be written: %s", path, strerror(errno));
    if (!ok || !replaceable)
        unlink(temporary);
    free(temporary);
    return ok;
}
