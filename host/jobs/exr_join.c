// SPDX-License-Identifier: MIT
// Each tile has a fixed place, because OpenEXR writes the tiles of a whole picture row by row.
#include "jobs/exr_join.h"

#include "jobs/stored_tiles.h"

#include <errno.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// A tile's position, as it precedes the tile's bytes: column, row, two zeros for the level of
// detail, and the number of bytes.
typedef uint32_t TileHead[5];

bool exr_join_begin(ExrJoin *join, const RenderSettings *settings, Error *error)
{
    RenderSettings whole = *settings;
    whole.part = whole.parts = 0;
    join->count = tile_count(&whole);
    join->starts = memory_zeroed(join->count, sizeof *join->starts, error);
    return join->starts != NULL;
}

void exr_join_free(ExrJoin *join)
{
    free(join->starts);
    *join = (ExrJoin){0};
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
        join->starts[found.idx] = sizeof(TileHead) + found.packed_size;
    }
    return true;
}

bool exr_join_write_table(ExrJoin *join, FILE *stream)
{
    const off_t size = (off_t)(join->count * sizeof *join->starts);
    if (fseeko(stream, -size, SEEK_END) != 0)
        return false;
    uint64_t next = (uint64_t)(ftello(stream) + size);
    for (uint64_t place = 0; place < join->count; place++) {
        const uint64_t tile_size = join->starts[place];
        join->starts[place] = next;
        next += tile_size;
    }
    return fwrite(join->starts, sizeof *join->starts, join->count, stream) == join->count &&
           fflush(stream) == 0;
}

typedef struct {
    const ExrJoin *join;
    const ExrFile *file;
    int output;
    atomic_int *cause; // why writing failed; 0 otherwise
} TileJoin;

static bool write_tile(const TileJoin *work, const exr_chunk_info_t *tile, unsigned char *bytes)
{
    const size_t size = sizeof(TileHead) + tile->packed_size;
    const TileHead head = {(uint32_t)tile->start_x, (uint32_t)tile->start_y, 0, 0,
                           (uint32_t)tile->packed_size};
    memcpy(bytes, head, sizeof head);
    errno = 0;
    if (pwrite(work->output, bytes, size, (off_t)work->join->starts[tile->idx]) == (ssize_t)size)
        return true;
    *work->cause = errno != 0 ? errno : ENOSPC;
    return false;
}

// Returns whether the tile is as long as in the first pass.
static bool fits(const ExrJoin *join, const exr_chunk_info_t *tile)
{
    const uint64_t next = (uint64_t)tile->idx + 1;
    return next == join->count ||
           join->starts[next] - join->starts[tile->idx] == sizeof(TileHead) + tile->packed_size;
}

static bool join_tile(const void *context, const Tile *tile, Error *error)
{
    const TileJoin *work = context;
    exr_chunk_info_t found;
    if (!stored_tiles_find(work->file, tile, &found, error))
        return false;
    unsigned char *bytes =
        memory_raw(sizeof(TileHead) + found.packed_size + found.unpacked_size, 1, error);
    if (bytes == NULL)
        return false;
    unsigned char *packed = bytes + sizeof(TileHead);
    bool ok = (fits(work->join, &found) &&
               exr_file_read(work->file, &found, packed, packed + found.packed_size)) ||
              error_set(error, "it is damaged at pixel %u,%u", tile->x, tile->y);
    ok = ok && write_tile(work, &found, bytes);
    free(bytes);
    return ok;
}

bool exr_join_copy(const ExrJoin *join, const ExrFile *file, const RenderSettings *settings,
                   FILE *stream, Error *error)
{
    atomic_int cause = 0;
    const TileJoin work = {join, file, fileno(stream), &cause};
    const bool ok = stored_tiles_run(settings, tile_count(settings), join_tile, &work, error);
    errno = cause;
    return ok;
}
