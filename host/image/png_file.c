// SPDX-License-Identifier: MIT
// libpng reports faults with longjmp to write_picture. write_picture and the functions it calls own
// no memory, because the jump would leak it.
#include "image/png_file.h"

#include "image/encode.h"
#include "image/png_faults.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

// This filter and strategy make the smallest files among all settings that take at most about 20 ms
// per megapixel. Paeth turns rendered surfaces into runs of zeros. Searching for matches other than
// runs costs more time than it saves. All compression levels find the same runs, so none is set.
#define FILTER   PNG_FILTER_PAETH
#define STRATEGY Z_RLE

#define CHANNEL_BITS 8

typedef struct {
    const Framebuffer *framebuffer;
    const ImageSettings *settings;
    unsigned char *row; // the current row, 8 bits per channel
} Picture;

// Replaces libpng's write function, which does not report why a write fails.
static void write_bytes(png_structp png, png_bytep bytes, size_t count)
{
    if (fwrite(bytes, 1, count, png_get_io_ptr(png)) != count)
        png_error(png, strerror(errno));
}

static void write_header(png_structp png, png_infop info, const Picture *picture)
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

static void write_rows(png_structp png, const Picture *picture)
{
    const size_t width = picture->framebuffer->width;
    for (size_t row = 0; row < picture->framebuffer->height; row++) {
        encode_channels(picture->framebuffer->pixels[row * width], 3 * width,
                        picture->settings->encoding, picture->row);
        png_write_row(png, picture->row);
    }
}

static bool write_picture(png_structp png, png_infop info, const Picture *picture)
{
    if (setjmp(png_jmpbuf(png)) != 0)
        return false;
    write_header(png, info, picture);
    write_rows(png, picture);
    png_write_end(png, NULL);
    return true;
}

static bool write_stream(FILE *stream, const Picture *picture, Error *error)
{
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, error, png_faults_take,
                                              png_faults_ignore_warning);
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
    const Picture picture = {framebuffer, settings, memory_raw(framebuffer->width, 3, error)};
    const bool ok = picture.row != NULL && write_stream(stream, &picture, error);
    free(picture.row);
    return ok && fflush(stream) == 0 && !ferror(stream);
}
