// SPDX-License-Identifier: MIT
// Writes a picture as a tiled EXR file. The file of a part contains only the part's tiles, but it
// has the header of the whole picture and a table with entries for all tiles. clrt merge can
// therefore copy tiles without decoding them.
//
// OpenEXRCore writes the header and compresses the tiles, but it cannot omit tiles. The code here
// therefore writes the table and the tiles itself. Threads compress tiles concurrently, but write
// them in the order of their numbers. Equal pictures therefore give equal files.
#include "image/exr_write.h"

#include "base/thread_pool.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

static int64_t write_bytes(exr_const_context_t context, void *stream, const void *bytes,
                           uint64_t size, uint64_t start, exr_stream_error_func_ptr_t report)
{
    (void)context;
    (void)start;
    (void)report;
    return fwrite(bytes, 1, size, stream) == size ? (int64_t)size : -1;
}

static bool add_layout(exr_context_t context, const ImageSettings *settings, uint32_t width,
                       uint32_t height)
{
    const ImagePart *part = settings->part;
    const int32_t left = (int32_t)settings->left, top = (int32_t)settings->top;
    const exr_attr_box2i_t window = {.min.x = left,
                                     .min.y = top,
                                     .max.x = left + (int32_t)width - 1,
                                     .max.y = top + (int32_t)height - 1};
    const exr_attr_box2i_t whole = {.max.x = (int32_t)settings->whole_width - 1,
                                    .max.y = (int32_t)settings->whole_height - 1};
    const exr_attr_v2f_t center = {.x = 0};
    return exr_add_part(context, NULL, EXR_STORAGE_TILED, NULL) == EXR_ERR_SUCCESS &&
           exr_initialize_required_attr(
               context, 0, settings->whole_width > 0 ? &whole : &window, &window, 1, &center, 1,
               part != NULL ? EXR_LINEORDER_RANDOM_Y : EXR_LINEORDER_INCREASING_Y,
               EXR_COMPRESSION_ZIP) == EXR_ERR_SUCCESS &&
           exr_set_tile_descriptor(context, 0, part != NULL ? part->tile_width : EXR_TILE,
                                   part != NULL ? part->tile_height : EXR_TILE, EXR_TILE_ONE_LEVEL,
                                   EXR_TILE_ROUND_DOWN) == EXR_ERR_SUCCESS;
}

static bool add_channels(exr_context_t context, const Layers *layers)
{
    static const LayerType colors[] = {{"R", false}, {"G", false}, {"B", false}};
    bool ok = true;
    for (uint32_t i = 0; ok && i < 3 + (layers != NULL ? layers->count : 0); i++) {
        const LayerType *type = i < 3 ? &colors[i] : &layers->list[i - 3];
        ok = exr_add_channel(context, 0, type->name,
                             type->is_integer ? EXR_PIXEL_UINT : EXR_PIXEL_FLOAT,
                             EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1) == EXR_ERR_SUCCESS;
    }
    return ok;
}

// clrt merge cannot compute a hash of pixels that it does not decode, so EXR files contain no such
// hash.
static bool add_texts(exr_context_t context, const ImageSettings *settings)
{
    bool ok = true;
    for (size_t i = 0; ok && i < settings->text_count; i++) {
        const char *name = settings->texts[i].name;
        if (strcmp(name, stored_text_names[STORED_PIXEL_HASH]) != 0)
            ok = exr_attr_set_string(context, 0, strcmp(name, "DateTime") == 0 ? "capDate" : name,
                                     settings->texts[i].value) == EXR_ERR_SUCCESS;
    }
    return ok;
}

bool exr_write_begin(exr_context_t *context, const ImageSettings *settings, uint32_t width,
                     uint32_t height, FILE *stream)
{
    const exr_context_initializer_t initial = {.size = sizeof initial,
                                               .error_handler_fn = exr_file_ignore,
                                               .user_data = stream,
                                               .write_fn = write_bytes,
                                               .zip_level = 4};
    return exr_start_write(context, "EXR", EXR_WRITE_FILE_DIRECTLY, &initial) == EXR_ERR_SUCCESS &&
           add_layout(*context, settings, width, height) &&
           add_channels(*context, settings->layers) && add_texts(*context, settings) &&
           exr_write_header(*context) == EXR_ERR_SUCCESS;
}

typedef struct {
    const Framebuffer *framebuffer;
    const ImageSettings *settings;
    exr_context_t context;
    FILE *stream;
    uint64_t *starts; // the positions of the tiles in the file
    pthread_mutex_t lock;
    pthread_cond_t turn; // signaled after each change of `next`
    uint32_t next;       // number of the tile to write next
    atomic_bool has_failed;
} TileWriter;

// Computes the column and row of a tile, and the position of its pixels in the framebuffer.
static bool find_tile(const TileWriter *writer, uint32_t number, exr_chunk_info_t *tile,
                      size_t position[2])
{
    const ImagePart *part = writer->settings->part;
    const uint32_t columns = range_count(writer->framebuffer->width, EXR_TILE);
    uint32_t column = number % columns, row = number / columns;
    position[0] = (size_t)column * EXR_TILE;
    position[1] = (size_t)row * EXR_TILE;
    if (part != NULL) {
        column = part->tiles[number][0] / part->tile_width;
        row = part->tiles[number][1] / part->tile_height;
        position[0] = 0;
        position[1] =
            (size_t)number * (part->tile_height < part->height ? part->tile_height : part->height);
    }
    return exr_write_tile_chunk_info(writer->context, 0, (int)column, (int)row, 0, 0, tile) ==
           EXR_ERR_SUCCESS;
}

static bool encode(const TileWriter *writer, const size_t position[2],
                   exr_encode_pipeline_t *encoder)
{
    exr_place_channels(encoder->channels, encoder->channel_count, writer->framebuffer,
                       writer->settings->layers, position);
    exr_encoding_choose_default_routines(writer->context, 0, encoder);
    encoder->yield_until_ready_fn = encoder->write_fn = NULL;
    if (exr_encoding_run(writer->context, 0, encoder) != EXR_ERR_SUCCESS)
        return false;
    // If compression does not change the size, readers expect uncompressed bytes. OpenEXRCore 3.1
    // provides compressed bytes even in this case.
    if (encoder->compressed_bytes == encoder->packed_bytes)
        memcpy(encoder->compressed_buffer, encoder->packed_buffer, encoder->packed_bytes);
    return true;
}

static bool write_tile(const TileWriter *writer, const exr_encode_pipeline_t *encoder)
{
    const ExrTileHead head = exr_tile_head(&encoder->chunk, encoder->compressed_bytes);
    writer->starts[encoder->chunk.idx] = (uint64_t)ftello(writer->stream);
    return fwrite(&head, sizeof head, 1, writer->stream) == 1 &&
           fwrite(encoder->compressed_buffer, encoder->compressed_bytes, 1, writer->stream) == 1;
}

// Compresses a tile, waits until all earlier tiles are written, and then writes the tile.
static void run_tile(void *context, uint32_t number)
{
    TileWriter *writer = context;
    exr_chunk_info_t tile;
    exr_encode_pipeline_t encoder = {0};
    size_t position[2];
    const bool ok =
        !writer->has_failed && find_tile(writer, number, &tile, position) &&
        exr_encoding_initialize(writer->context, 0, &tile, &encoder) == EXR_ERR_SUCCESS &&
        encode(writer, position, &encoder);
    pthread_mutex_lock(&writer->lock);
    while (writer->next != number)
        pthread_cond_wait(&writer->turn, &writer->lock);
    if (!ok || writer->has_failed || !write_tile(writer, &encoder))
        writer->has_failed = true;
    writer->next++;
    pthread_cond_broadcast(&writer->turn);
    pthread_mutex_unlock(&writer->lock);
    exr_encoding_destroy(writer->context, &encoder);
}

// Leaves space for the table of tiles, writes the tiles, and then writes the table.
static bool write_tiles(TileWriter *writer, uint32_t count)
{
    const off_t table = ftello(writer->stream);
    const size_t size = count * sizeof *writer->starts;
    const ImagePart *part = writer->settings->part;
    if (fseeko(writer->stream, table + (off_t)size, SEEK_SET) != 0)
        return false;
    ThreadPool *pool = thread_pool_open(0);
    thread_pool_run(pool, part != NULL ? (uint32_t)part->tile_count : count, run_tile, writer);
    thread_pool_close(pool);
    return !writer->has_failed && fseeko(writer->stream, table, SEEK_SET) == 0 &&
           fwrite(writer->starts, size, 1, writer->stream) == 1 && fflush(writer->stream) == 0;
}

bool exr_write(const Framebuffer *framebuffer, const ImageSettings *settings, FILE *stream,
               Error *cause)
{
    const ImagePart *part = settings->part;
    TileWriter writer = {.framebuffer = framebuffer,
                         .settings = settings,
                         .stream = stream,
                         .lock = PTHREAD_MUTEX_INITIALIZER,
                         .turn = PTHREAD_COND_INITIALIZER};
    int32_t count = 0;
    bool ok =
        exr_write_begin(&writer.context, settings, part != NULL ? part->width : framebuffer->width,
                        part != NULL ? part->height : framebuffer->height, stream) &&
        exr_get_chunk_count(writer.context, 0, &count) == EXR_ERR_SUCCESS;
    writer.starts = memory_zeroed((size_t)count, sizeof *writer.starts, cause);
    ok = ok && writer.starts != NULL && write_tiles(&writer, (uint32_t)count);
    if (!ok && !ferror(stream))
        error_set(cause, "OpenEXR cannot encode it");
    exr_finish(&writer.context);
    free(writer.starts);
    return ok;
}
