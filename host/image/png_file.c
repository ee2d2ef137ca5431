// SPDX-License-Identifier: MIT
// Writes and reads PNG by libpng, row by row. libpng converts every kind of PNG to red, green and
// blue. libpng reports faults by a longjmp to write_picture or read_picture. The jump skips the
// cleanup of all functions in between, so these functions must own no memory.
#include "image/png_file.h"

#include <errno.h>
#include <math.h>
#include <png.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

// This filter and strategy make the smallest files of all settings that take at most about 20 ms
// per megapixel. The Paeth filter turns rendered surfaces into runs of zeros. Strategies that also
// search for other matches take more time or make larger files. All compression levels above 0 find
// the same runs, so the code sets no level.
#define FILTER   PNG_FILTER_PAETH
#define STRATEGY Z_RLE

#define CHANNEL_BITS 8

typedef struct {
    const Framebuffer *framebuffer;
    const ImageSettings *settings;
    unsigned char *row; // the current row, 8 bits per channel
} PngSource;

// The fault handlers for libpng. libpng's error pointer points to an Error.
static void take_fault(png_structp png, png_const_charp reason)
{
    error_set(png_get_error_ptr(png), "%s", reason);
    png_longjmp(png, 1);
}

static void ignore_warning(png_structp png, png_const_charp warning)
{
    (void)png;
    (void)warning;
}

// Replaces libpng's write function, which does not report why a write fails.
static void write_bytes(png_structp png, png_bytep bytes, size_t count)
{
    if (fwrite(bytes, 1, count, png_get_io_ptr(png)) != count)
        png_error(png, strerror(errno));
}

static void write_header(png_structp png, png_infop info, const PngSource *picture)
{
    const Framebuffer *framebuffer = picture->framebuffer;
    png_set_compression_strategy(png, STRATEGY);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, FILTER);
    png_set_IHDR(png, info, framebuffer->width, framebuffer->height, CHANNEL_BITS,
                 PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_BASE,
                 PNG_FILTER_TYPE_BASE);
    for (size_t i = 0; i < picture->settings->text_count; i++) {
        const ImageText *text = &picture->settings->texts[i];
        // The casts are safe, because libpng copies both strings.
        const png_text entry = {.compression = PNG_TEXT_COMPRESSION_NONE,
                                .key = (char *)text->name,
                                .text = (char *)text->value,
                                .text_length = strlen(text->value)};
        png_set_text(png, info, &entry, 1);
    }
    png_write_info(png, info);
}

static void write_rows(png_structp png, const PngSource *picture)
{
    const size_t width = picture->framebuffer->width;
    for (size_t row = 0; row < picture->framebuffer->height; row++) {
        framebuffer_encode(picture->framebuffer->pixels[row * width], 3 * width,
                           picture->settings->encoding, exp2(picture->settings->exposure),
                           picture->row);
        png_write_row(png, picture->row);
    }
}

static bool write_picture(png_structp png, png_infop info, const PngSource *picture)
{
    if (setjmp(png_jmpbuf(png)) != 0)
        return false;
    write_header(png, info, picture);
    write_rows(png, picture);
    png_write_end(png, NULL);
    return true;
}

static bool write_stream(FILE *stream, const PngSource *picture, Error *error)
{
    png_structp png =
        png_create_write_struct(PNG_LIBPNG_VER_STRING, error, take_fault, ignore_warning);
    png_infop info = png == NULL ? NULL : png_create_info_struct(png);
    bool ok = info != NULL || error_set(error, "libpng does not start");
    if (ok) {
        png_set_write_fn(png, stream, write_bytes, NULL);
        ok = write_picture(png, info, picture);
    }
    png_destroy_write_struct(&png, &info);
    return ok;
}

bool png_file_write(const Framebuffer *framebuffer, const ImageSettings *settings, FILE *stream,
                    Error *error)
{
    const PngSource picture = {framebuffer, settings, memory_raw(framebuffer->width, 3, error)};
    const bool ok = picture.row != NULL && write_stream(stream, &picture, error);
    free(picture.row);
    return ok && fflush(stream) == 0 && !ferror(stream);
}

// Limits for a PNG file: the decompressed size of each text or profile, in bytes, and the number of
// texts and profiles.
#define CHUNK_SIZE_MAX  1000000
#define CHUNK_COUNT_MAX 64

typedef struct {
    StoredImage *image;
    uint64_t most;        // values that the picture may have
    unsigned char *bytes; // the whole picture, because interlaced files store it in several passes
    int passes;
    Error *cause;
} Loading;

static void read_bytes(png_structp png, png_bytep bytes, size_t count)
{
    if (fread(bytes, 1, count, png_get_io_ptr(png)) != count)
        png_error(png, "it ends early");
}

static void copy_texts(png_structp png, png_infop info, StoredImage *image)
{
    png_textp texts;
    int count = 0;
    png_get_text(png, info, &texts, &count);
    for (int i = 0; i < count; i++)
        for (int kind = 0; kind < STORED_TEXTS; kind++)
            if (strcmp(texts[i].key, stored_text_names[kind]) == 0)
                snprintf(image->texts[kind], sizeof image->texts[kind], "%s", texts[i].text);
}

static void read_header(png_structp png, png_infop info, StoredImage *image)
{
    png_read_info(png, info);
    *image = (StoredImage){.width = png_get_image_width(png, info),
                           .height = png_get_image_height(png, info),
                           .channel_count = 3,
                           .names = {"R", "G", "B"}};
    copy_texts(png, info, image);
    png_set_expand(png);
    png_set_gray_to_rgb(png);
    png_set_strip_alpha(png);
    if (png_get_bit_depth(png, info) == 16)
        png_set_swap(png);
}

static void read_rows(png_structp png, png_infop info, const Loading *loading)
{
    const size_t row_size = png_get_rowbytes(png, info);
    for (int pass = 0; pass < loading->passes; pass++)
        for (size_t row = 0; row < loading->image->height; row++)
            png_read_row(png, loading->bytes + row * row_size, NULL);
    png_read_end(png, NULL);
}

static void store_values(const Loading *loading, int depth)
{
    StoredImage *image = loading->image;
    const size_t count = (size_t)image->width * image->height * 3;
    if (depth == 8)
        stored_image_values(loading->bytes, count, image->values);
    for (size_t i = 0; depth == 16 && i < count; i++) {
        uint16_t value;
        memcpy(&value, loading->bytes + 2 * i, sizeof value);
        image->values[i] = (float)value / 65535;
    }
}

static bool read_picture(png_structp png, png_infop info, Loading *loading)
{
    if (setjmp(png_jmpbuf(png)) != 0)
        return false;
    read_header(png, info, loading->image);
    loading->passes = png_set_interlace_handling(png);
    png_read_update_info(png, info);
    if (!stored_image_check_size(loading->image, loading->most, loading->cause) ||
        !stored_image_allocate(loading->image, loading->cause))
        return false;
    loading->bytes =
        memory_raw(loading->image->height, png_get_rowbytes(png, info), loading->cause);
    if (loading->bytes == NULL)
        return false;
    read_rows(png, info, loading);
    store_values(loading, png_get_bit_depth(png, info));
    return true;
}

bool png_file_read(StoredImage *image, FILE *stream, uint64_t most, Error *cause)
{
    Loading loading = {.image = image, .most = most, .cause = cause};
    png_structp png =
        png_create_read_struct(PNG_LIBPNG_VER_STRING, cause, take_fault, ignore_warning);
    png_infop info = png == NULL ? NULL : png_create_info_struct(png);
    bool ok = info != NULL || error_set(cause, "libpng does not start");
    if (ok) {
        png_set_read_fn(png, stream, read_bytes);
        png_set_user_limits(png, STORED_SIDE_MAX, STORED_SIDE_MAX);
        png_set_chunk_malloc_max(png, CHUNK_SIZE_MAX);
        png_set_chunk_cache_max(png, CHUNK_COUNT_MAX);
        ok = read_picture(png, info, &loading);
    }
    png_destroy_read_struct(&png, &info, NULL);
    free(loading.bytes);
    return ok;
}
