// SPDX-License-Identifier: MIT
// Reads any PNG file as red, green and blue. libpng reports faults with longjmp to read_picture,
// whose caller frees all memory (Loading).
#include "image/png_load.h"

#include "image/png_faults.h"

#include <stdlib.h>
#include <string.h>

// The largest text or profile in a PNG file, in bytes after decompression.
#define CHUNK_SIZE_MAX 1000000

typedef struct {
    StoredImage *image;
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
    if (!stored_image_allocate(loading->image, loading->cause))
        return false;
    loading->bytes =
        memory_raw(loading->image->height, png_get_rowbytes(png, info), loading->cause);
    if (loading->bytes == NULL)
        return false;
    read_rows(png, info, loading);
    store_values(loading, png_get_bit_depth(png, info));
    return true;
}

bool png_load(StoredImage *image, FILE *stream, Error *cause)
{
    Loading loading = {.image = image, .cause = cause};
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, cause, png_faults_take,
                                             png_faults_ignore_warning);
    png_infop info = png == NULL ? NULL : png_create_info_struct(png);
    bool ok = info != NULL || error_set(cause, "libpng does not start");
    if (ok) {
        png_set_read_fn(png, stream, read_bytes);
        png_set_user_limits(png, STORED_SIDE_MAX, STORED_SIDE_MAX);
        png_set_chunk_malloc_max(png, CHUNK_SIZE_MAX);
        ok = read_picture(png, info, &loading);
    }
    png_destroy_read_struct(&png, &info, NULL);
    free(loading.bytes);
    return ok;
}
