// SPDX-License-Identifier: MIT
// OpenEXRCore parses the file. A tile of ZIP compression ends with the Adler-32 checksum of its
// values.
#include "image/exr_file.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <zlib.h>

static void ignore_message(exr_const_context_t context, exr_result_t code, const char *message)
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
    const int64_t width = (int64_t)window.max.x - window.min.x + 1,
                  height = (int64_t)window.max.y - window.min.y + 1;
    file->head.width = (uint32_t)width;
    file->head.height = (uint32_t)height;
    return width >= 1 && width <= EXR_SIDE_MAX && height >= 1 && height <= EXR_SIDE_MAX;
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
    int32_t count;
    return exr_get_chunk_count(file->context, 0, &count) == EXR_ERR_SUCCESS && count > 0 &&
           exr_get_compression(file->context, 0, &compression) == EXR_ERR_SUCCESS &&
           compression == EXR_COMPRESSION_ZIP &&
           exr_get_tile_descriptor(file->context, 0, &file->tile_width, &file->tile_height, &levels,
                                   &rounding) == EXR_ERR_SUCCESS &&
           levels == EXR_TILE_ONE_LEVEL && file->tile_width <= EXR_SIDE_MAX &&
           file->tile_height <= EXR_SIDE_MAX;
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

bool exr_file_open(ExrFile *file, const char *path, Error *error)
{
    const exr_context_initializer_t settings = {
        .size = sizeof settings,
        .error_handler_fn = ignore_message,
        .flags = EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION, // tiles may be missing
    };
    *file = (ExrFile){0};
    errno = 0;
    const exr_result_t result = exr_start_read(&file->context, path, &settings);
    if ((result == EXR_ERR_FILE_ACCESS || result == EXR_ERR_READ_IO) && errno != 0)
        return error_set(error, "%s: cannot be read: %s", path, strerror(errno));
    if (result != EXR_ERR_SUCCESS || !read_tiling(file) || !read_size(file) || !read_channels(file))
        return error_set(error, "%s: cannot be read: it is no EXR file of tiles, as clrt writes it",
                         path);
    read_texts(file);
    return true;
}

void exr_file_close(ExrFile *file)
{
    exr_finish(&file->context);
    *file = (ExrFile){0};
}

bool exr_file_find(const ExrFile *file, uint32_t column, uint32_t row, exr_chunk_info_t *tile)
{
    return exr_read_tile_chunk_info(file->context, 0, (int)column, (int)row, 0, 0, tile) ==
           EXR_ERR_SUCCESS;
}

bool exr_file_read(const ExrFile *file, const exr_chunk_info_t *tile, unsigned char *bytes,
                   unsigned char *scratch)
{
    uLongf length = tile->unpacked_size;
    uLong taken = tile->packed_size;
    if (exr_read_chunk(file->context, 0, tile, bytes) != EXR_ERR_SUCCESS)
        return false;
    return tile->packed_size == tile->unpacked_size ||
           (uncompress2(scratch, &length, bytes, &taken) == Z_OK && length == tile->unpacked_size &&
            taken == tile->packed_size);
}

bool exr_file_decode(const ExrFile *file, const exr_chunk_info_t *tile, const ExrTarget *targets)
{
    exr_decode_pipeline_t decoder = {0};
    bool ok = exr_decoding_initialize(file->context, 0, tile, &decoder) == EXR_ERR_SUCCESS;
    for (int i = 0; i < decoder.channel_count; i++) {
        decoder.channels[i].decode_to_ptr = targets[i].start;
        decoder.channels[i].user_pixel_stride = (int32_t)targets[i].pixel_size;
        decoder.channels[i].user_line_stride = (int32_t)targets[i].line_size;
        decoder.channels[i].user_bytes_per_element = sizeof(uint32_t);
    }
    ok = ok &&
         exr_decoding_choose_default_routines(file->context, 0, &decoder) == EXR_ERR_SUCCESS &&
         exr_decoding_run(file->context, 0, &decoder) == EXR_ERR_SUCCESS;
    exr_decoding_destroy(file->context, &decoder);
    return ok;
}
