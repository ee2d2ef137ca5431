// SPDX-License-Identifier: MIT
// Selects the writer or the reader of a picture. A table lists the formats that clrt writes, with
// the sizes that they can store. The first bytes of a file select its reader.
#include "image/image_file.h"

#include "base/foreign.h"
#include "base/output_file.h"
#include "image/exr_write.h"
#include "image/image_module.h"
#include "image/pfm.h"
#include "image/png_file.h"

#include <dlfcn.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

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

static bool find_module(char path[COMPANION_PATH_SIZE], Error *cause)
{
    return foreign_companion(path, CLRT_IMAGE_MODULE,
                             CLRT_IMAGE_MODULE_FOLDER "/" CLRT_IMAGE_MODULE) ||
           error_set(cause, "the picture module %s cannot be found", CLRT_IMAGE_MODULE);
}

typedef void ModuleFunction(void);

// Opens the module and returns its function `name`, which the caller casts to the right type.
// Returns NULL on failure.
static ModuleFunction *open_module(const char *name, Error *cause)
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

// The following functions read pictures. clrt reads only formats that it writes, because every
// further decoder of OpenImageIO would be a target for hostile files. clrt-foreign calls
// OpenImageIO, and the code here validates everything that clrt-foreign sends.

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

// Reads a file by clrt-foreign in a format of OpenImageIO. The picture has at most `most` values.
static bool read_by_module(StoredImage *image, const char *path, const char *format, uint64_t most,
                           Error *cause)
{
    char module[COMPANION_PATH_SIZE];
    const char *const words[FOREIGN_WORDS] = {path, format, module};
    const size_t heads = sizeof(ForeignHead) + sizeof(StoredImage);
    const ForeignReader reader = {
        .library = "OpenImageIO", .seconds = 125, .bytes = heads + most * sizeof(float)};
    File stream = {0};
    const bool ok = find_module(module, cause) && foreign_run(&stream, &reader, words, cause) &&
                    take_picture(image, &stream, most, cause);
    file_free(&stream);
    return ok;
}

typedef struct {
    const char *start;
    size_t length;
    const char *module; // OpenImageIO's name of the format
} Signature;

#ifdef CLRT_WITH_OPENIMAGEIO
static const Signature signatures[] = {
    {"\xff\xd8\xff", 3, "jpeg"},
    {"II*\0", 4, "tiff"},
    {"MM\0*", 4, "tiff"},
    {"\x76\x2f\x31\x01", 4, "openexr"},
    {"#?", 2, "hdr"},
    {"P3", 2, "pnm"},
    {"P6", 2, "pnm"},
    {"P5", 2, "pnm"},
    {"P2", 2, "pnm"},
};
#define READABLE "PNG, JPEG, TIFF, PPM, EXR, HDR or PFM file"
#else
static const Signature signatures[] = {{"", SIZE_MAX, NULL}};
#define READABLE "PNG or PFM file, and this build reads no other format"
#endif

static const char *module_format(const char *start, size_t length)
{
    for (size_t i = 0; i < sizeof signatures / sizeof signatures[0]; i++)
        if (length >= signatures[i].length &&
            memcmp(start, signatures[i].start, signatures[i].length) == 0)
            return signatures[i].module;
    return NULL;
}

static uint32_t read_integer(const char *bytes, int size, bool is_big_endian)
{
    uint32_t value = 0;
    for (int i = 0; i < size; i++)
        value = value << 8 | (unsigned char)bytes[is_big_endian ? i : size - 1 - i];
    return value;
}

// Returns whether a TIFF file's first directory contains BitsPerSample, or cannot be read. Without
// this tag, a sample has 1 bit, but OpenImageIO would return bytes of 8 pixels as colors.
static bool tiff_has_depth(FILE *stream, const char start[8])
{
    const bool is_big_endian = start[0] == 'M';
    char entry[12];
    if (fseek(stream, (long)read_integer(start + 4, 4, is_big_endian), SEEK_SET) != 0 ||
        fread(entry, 2, 1, stream) != 1)
        return true;
    for (uint32_t left = read_integer(entry, 2, is_big_endian); left > 0; left--)
        if (fread(entry, sizeof entry, 1, stream) != 1 ||
            read_integer(entry, 2, is_big_endian) == 258)
            return true;
    return false;
}

static bool read_stream(StoredImage *image, FILE *stream, const char *path, Error *cause)
{
    char start[8];
    struct stat status;
    const size_t length = fread(start, 1, sizeof start, stream);
    if (ferror(stream) || fseek(stream, 0, SEEK_SET) != 0 || fstat(fileno(stream), &status) != 0)
        return error_set(cause, "%s", strerror(errno));
    const uint64_t most = stored_values_most((uint64_t)status.st_size);
    if (length == 8 && memcmp(start, "\x89PNG\r\n\x1a\n", 8) == 0)
        return png_file_read(image, stream, most, cause);
    if (length >= 2 && start[0] == 'P' && (start[1] == 'F' || start[1] == 'f'))
        return pfm_read(image, stream, most, cause);
    const char *format = module_format(start, length);
    if (format == NULL)
        return error_set(cause, "it is not a %s", READABLE);
    if (strcmp(format, "tiff") == 0 && length == 8 && !tiff_has_depth(stream, start))
        return error_set(cause, "its pixels of 1 bit are not supported without BitsPerSample");
    return read_by_module(image, path, format, most, cause);
}

// Rejects pipes and devices, because their data may never end. Pipes cannot be rewound either.
static FILE *open_file(const char *path, Error *cause)
{
    struct stat status;
    if (stat(path, &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode)) {
        error_set(cause, "it is not a file");
        return NULL;
    }
    FILE *stream = fopen(path, "rbe");
    if (stream == NULL)
        error_set(cause, "%s", strerror(errno));
    return stream;
}

bool image_read(StoredImage *image, const char *path, Error *error)
{
    *image = (StoredImage){0};
    Error cause = {0};
    FILE *stream = open_file(path, &cause);
    const bool ok = stream != NULL && read_stream(image, stream, path, &cause);
    if (stream != NULL)
        fclose(stream);
    if (ok)
        return true;
    stored_image_free(image);
    return error_set(error, "%s: cannot be read: %s", path, cause.text);
}
