// SPDX-License-Identifier: MIT
// Reads and checks the tiles of an EXR file. OpenEXRCore parses the file and decodes tiles. A tile
// with ZIP compression ends with the Adler-32 checksum of its uncompressed bytes. libdeflate
// verifies the checksum in half the time of zlib.
#include "image/exr_file.h"

#include <errno.h>
#include <libdeflate.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define DEFLATE_RATIO 1032 // the most bytes that one compressed byte can represent

void exr_file_ignore(exr_const_context_t context, exr_result_t code, const char *message)
{
    (void)context;
    (void)code;
    (void)message;
}

static bool read_size(ExrFile *file)
{
    exr_attr_box2i_t window;
    if (exr_get_data_window(file->context, 0, &window) != EXR_ERR_SUCCESS)
        return false;
    file->head.width = (uint32_t)(window.max.x - window.min.x + 1);
    file->head.height = (uint32_t)(window.max.y - window.min.y + 1);
    return true;
}

static bool read_channels(ExrFile *file)
{
    const exr_attr_chlist_t *list;
    if (exr_get_channels(file->context, 0, &list) != EXR_ERR_SUCCESS || list->num_channels < 1 ||
        list->num_channels > STORED_CHANNELS_MAX)
        return false;
    file->head.channel_count = (uint32_t)list->num_channels;
    for (int i = 0; i < list->num_channels; i++) {
        const exr_attr_chlist_entry_t *entry = &list->entries[i];
        if (entry->name.length >= STORED_NAME_SIZE || entry->pixel_type == EXR_PIXEL_HALF ||
            entry->x_sampling != 1 || entry->y_sampling != 1)
            return false;
        memcpy(file->head.names[i], entry->name.str, (size_t)entry->name.length);
    }
    return true;
}

static bool read_tiling(ExrFile *file)
{
    exr_compression_t compression;
    exr_tile_level_mode_t levels;
    exr_tile_round_mode_t rounding;
    int32_t count = 0;
    exr_get_chunk_count(file->context, 0, &count);
    file->tile_count = (uint32_t)count;
    return count > 0 && exr_get_compression(file->context, 0, &compression) == EXR_ERR_SUCCESS &&
           compression == EXR_COMPRESSION_ZIP &&
           exr_get_tile_descriptor(file->context, 0, &file->tile_width, &file->tile_height, &levels,
                                   &rounding) == EXR_ERR_SUCCESS &&
           levels == EXR_TILE_ONE_LEVEL;
}

static void read_texts(ExrFile *file)
{
    int32_t length;
    const char *text;
    for (int kind = 0; kind < STORED_TEXTS; kind++)
        if (exr_attr_get_string(file->context, 0, stored_text_names[kind], &length, &text) ==
            EXR_ERR_SUCCESS)
            snprintf(file->head.texts[kind], STORED_TEXT_SIZE, "%s", text);
}

static int64_t read_bytes(exr_const_context_t context, void *user, void *bytes, uint64_t size,
                          uint64_t offset, exr_stream_error_func_ptr_t fail)
{
    const ExrFile *file = user;
    (void)context, (void)fail;
    return offset > file->most ? -1 : pread(fileno(file->stream), bytes, size, (off_t)offset);
}

static int64_t query_size(exr_const_context_t context, void *user)
{
    const ExrFile *file = user;
    struct stat status;
    (void)context;
    return fstat(fileno(file->stream), &status) == 0 ? (int64_t)status.st_size : -1;
}

// No read of the header may begin beyond this offset. clrt writes headers of at most 10 KB. The
// limit stops hostile headers, because OpenEXRCore takes quadratic time in the number of
// attributes.
#define HEADER_MOST 65536

static exr_result_t start(ExrFile *file, const char *path)
{
    const exr_context_initializer_t settings = {
        .size = sizeof settings,
        .error_handler_fn = exr_file_ignore,
        .user_data = file,
        .read_fn = read_bytes,
        .size_fn = query_size,
        .flags = EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION, // tiles may be missing
    };
    file->most = HEADER_MOST;
    const exr_result_t result = exr_start_read(&file->context, path, &settings);
    file->most = INT64_MAX;
    return result;
}

bool exr_file_open(ExrFile *file, const char *path, Error *error)
{
    *file = (ExrFile){.stream = fopen(path, "rbe")};
    if (file->stream == NULL)
        return error_set(error, "%s: cannot be read: %s", path, strerror(errno));
    errno = 0;
    const exr_result_t result = start(file, path);
    if ((result == EXR_ERR_FILE_ACCESS || result == EXR_ERR_READ_IO) && errno != 0)
        return error_set(error, "%s: cannot be read: %s", path, strerror(errno));
    if (result != EXR_ERR_SUCCESS || !read_tiling(file) || !read_size(file) || !read_channels(file))
        return error_set(error, "%s: cannot be read: it is not a tiled EXR file written by clrt",
                         path);
    read_texts(file);
    return true;
}

void exr_file_close(ExrFile *file)
{
    exr_finish(&file->context);
    if (file->stream != NULL)
        fclose(file->stream);
    *file = (ExrFile){0};
}

bool exr_file_find(const ExrFile *file, uint32_t column, uint32_t row, exr_chunk_info_t *tile)
{
    return exr_read_tile_chunk_info(file->context, 0, (int)column, (int)row, 0, 0, tile) ==
               EXR_ERR_SUCCESS &&
           tile->unpacked_size / DEFLATE_RATIO <= tile->packed_size;
}

bool exr_file_read(const ExrFile *file, const exr_chunk_info_t *tile, unsigned char *bytes,
                   unsigned char *scratch)
{
    size_t taken;
    if (exr_read_chunk(file->context, 0, tile, bytes) != EXR_ERR_SUCCESS)
        return false;
    if (tile->packed_size == tile->unpacked_size)
        return true;
    struct libdeflate_decompressor *decompressor = libdeflate_alloc_decompressor();
    const bool ok =
        decompressor != NULL &&
        libdeflate_zlib_decompress_ex(decompressor, bytes, tile->packed_size, scratch,
                                      tile->unpacked_size, &taken, NULL) == LIBDEFLATE_SUCCESS &&
        taken == tile->packed_size;
    libdeflate_free_decompressor(decompressor);
    return ok;
}

void exr_place_channels(exr_coding_channel_info_t *channels, int count,
                        const Framebuffer *framebuffer, const Layers *layers,
                        const size_t position[2])
{
    static const char *const colors[] = {"R", "G", "B"};
    const size_t pixel = position[1] * framebuffer->width + position[0];
    const uint32_t layer_count = layers != NULL ? layers->count : 0;
    for (exr_coding_channel_info_t *channel = channels; channel < channels + count; channel++) {
        for (uint32_t i = 0; i < 3 + layer_count; i++) {
            if (strcmp(channel->channel_name, i < 3 ? colors[i] : layers->list[i - 3].name) != 0)
                continue;
            const size_t size = (i < 3 ? 3 : layer_count) * sizeof(uint32_t);
            channel->decode_to_ptr = i < 3
                                         ? (uint8_t *)&framebuffer->pixels[pixel][i]
                                         : (uint8_t *)&layers->values[pixel * layer_count + i - 3];
            channel->user_pixel_stride = (int32_t)size;
            channel->user_line_stride = (int32_t)(framebuffer->width * size);
        }
    }
}

ExrTileHead exr_tile_head(const exr_chunk_info_t *tile, uint64_t size)
{
    return (ExrTileHead){
        .column = (uint32_t)tile->start_x, .row = (uint32_t)tile->start_y, .size = (uint32_t)size};
}

bool exr_file_decode(const ExrFile *file, const exr_chunk_info_t *tile,
                     const Framebuffer *framebuffer, const Layers *layers, const size_t position[2])
{
    exr_decode_pipeline_t decoder = {0};
    bool ok = exr_decoding_initialize(file->context, 0, tile, &decoder) == EXR_ERR_SUCCESS;
    exr_place_channels(decoder.channels, decoder.channel_count, framebuffer, layers, position);
    ok = ok &&
         exr_decoding_choose_default_routines(file->context, 0, &decoder) == EXR_ERR_SUCCESS &&
         exr_decoding_run(file->context, 0, &decoder) == EXR_ERR_SUCCESS;
    exr_decoding_destroy(file->context, &decoder);
    return ok;
}
