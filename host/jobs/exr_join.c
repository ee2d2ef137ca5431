// SPDX-License-Identifier: MIT
// Copies the compressed tiles of parts into one file. The tiles of a whole picture are stored row
// by row, so their sizes determine where each tile starts. Threads can then write in any order.
#include "jobs/exr_join.h"

#include "image/exr_write.h"
#include "jobs/stored_tiles.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool exr_join_begin(ExrJoin *join, const ExrFile *file, Error *error)
{
    join->count = file->tile_count;
    join->starts = memory_zeroed(join->count, sizeof *join->starts, error);
    return join->starts != NULL;
}

bool exr_join_measure(ExrJoin *join, const ExrFile *file, const RenderSettings *settings,
                      Error *error)
{
    exr_chunk_info_t found;
    const uint64_t count = tile_count(settings);
    for (uint64_t number = 0; number < count; number++) {
        const Tile tile = tile_at(settings, number);
        if (!stored_tiles_find(file, &tile, &found, error))
            return false;
        join->starts[found.idx] = sizeof(ExrTileHead) + found.packed_size;
    }
    return true;
}

bool exr_join_write_head(ExrJoin *join, const ImageSettings *settings, const RenderSettings *place,
                         FILE *stream)
{
    exr_context_t context = NULL;
    const bool ok = exr_write_begin(&context, settings, place->width, place->height, stream);
    exr_finish(&context);
    uint64_t next = (uint64_t)ftello(stream) + join->count * sizeof next;
    for (uint64_t tile = 0; tile < join->count; tile++) {
        const uint64_t size = join->starts[tile];
        join->starts[tile] = next;
        next += size;
    }
    return ok && fwrite(join->starts, sizeof *join->starts, join->count, stream) == join->count &&
           fflush(stream) == 0;
}

typedef struct {
    ExrJoin *join;
    const ExrFile *file;
    int output;
} TileJoin;

// Fills `bytes` with the tile's head and compressed data. Returns false if the tile is damaged, or
// if its size has changed since the first pass. The last tile's size is not checked, because no
// tile starts after it.
static bool read_tile(const TileJoin *work, const exr_chunk_info_t *tile, unsigned char *bytes)
{
    const ExrJoin *join = work->join;
    const uint64_t next = (uint64_t)tile->idx + 1, size = sizeof(ExrTileHead) + tile->packed_size;
    const ExrTileHead head = exr_tile_head(tile, tile->packed_size);
    memcpy(bytes, &head, sizeof head);
    return (next == join->count || join->starts[next] - join->starts[tile->idx] == size) &&
           exr_file_read(work->file, tile, bytes + sizeof head, bytes + size);
}

static bool write_tile(const TileJoin *work, const exr_chunk_info_t *tile,
                       const unsigned char *bytes)
{
    const size_t size = sizeof(ExrTileHead) + tile->packed_size;
    errno = ENOSPC; // a short write sets no errno
    if (pwrite(work->output, bytes, size, (off_t)work->join->starts[tile->idx]) == (ssize_t)size)
        return true;
    work->join->write_error = errno;
    return false;
}

static bool join_tile(const void *context, const Tile *tile, Error *error)
{
    const TileJoin *work = context;
    exr_chunk_info_t found;
    if (!stored_tiles_find(work->file, tile, &found, error))
        return false;
    unsigned char *bytes =
        memory_raw(sizeof(ExrTileHead) + found.packed_size + found.unpacked_size, 1, error);
    const bool ok = bytes != NULL &&
                    (read_tile(work, &found, bytes) ||
                     error_set(error, "it is damaged at pixel %u,%u", tile->x, tile->y)) &&
                    write_tile(work, &found, bytes);
    free(bytes);
    return ok;
}

bool exr_join_copy(ExrJoin *join, const ExrFile *file, const RenderSettings *settings, FILE *stream,
                   Error *error)
{
    const TileJoin work = {join, file, fileno(stream)};
    return stored_tiles_run(settings, tile_count(settings), join_tile, &work, error);
}
