// SPDX-License-Identifier: MIT
// Selects the reader by the file's first bytes. clrt reads only formats that it writes, because
// every further decoder of OpenImageIO would be a target for hostile files.
#include "image/image_read.h"

#include "image/image_process.h"
#include "image/pfm.h"
#include "image/png_file.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

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

static bool read_stream(StoredImage *image, FILE *stream, const char *path, Error *cause)
{
    char start[8];
    struct stat status;
    const size_t length = fread(start, 1, sizeof start, stream);
    if (ferror(stream) || fseek(stream, 0, SEEK_SET) != 0 || fstat(fileno(stream), &status) != 0)
        return error_set(cause, "%s", strerror(errno));
    const uint64_t bytes = (uint64_t)status.st_size, most = stored_values_most(bytes);
    if (length == 8 && memcmp(start, "\x89PNG\r\n\x1a\n", 8) == 0)
        return png_file_read(image, stream, most, cause);
    if (length >= 2 && start[0] == 'P' && (start[1] == 'F' || start[1] == 'f'))
        return pfm_read(image, stream, most, cause);
    const char *format = module_format(start, length);
    if (format == NULL)
        return error_set(cause, "it is not a %s", READABLE);
    return image_process_read(image, &(ImageRequest){path, format, bytes}, cause);
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
