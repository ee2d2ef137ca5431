// SPDX-License-Identifier: MIT
// Each tile has a fixed place, because OpenEXR writes the tiles of a whole picture row by row.
#include "jobs/exr_join.h"

#include <errno.h>
#include <stdlib.h>
#include <unistd.h>

bool exr_join_begin(ExrJoin *join, const ExrFile *file, const RenderSettings *settings,
                    Error *error)
{
    *join = (ExrJoin){.whole = *settings};
    join->whole.part = join->whole.parts = 0;
    join->count = tile_count(&join->whole);
    join->starts = memory_zeroed(join->count, sizeof *join->starts, error);
    join->tile = memory_raw(
        sizeof(ExrTileHead) + exr_tile_bytes(file, file->tile_width, file->tile_height), 1, error);
    return join->starts != NULL && join->tile != NULL;
}

void exr_join_free(ExrJoin *join)
{
    free(join->starts);
    free(join->tile);
    *join = (ExrJoin){0};
}

static uint64_t place_of(const ExrFile *file, const Tile *tile)
{
    const uint64_t columns = ((uint64_t)file->head.width + file->tile_width - 1) / file->tile_width;
    return tile->y / file->tile_height * columns + tile->x / file->tile_width;
}

static bool find(const ExrFile *file, const Tile *tile, uint64_t *start, uint64_t *size)
{
    ExrTileHead head;
    const bool ok =
        exr_file_find(file, tile->x / file->tile_width, tile->y / file->tile_height, start, &head);
    *size = sizeof head + head.size;
    return ok && *start <= file->bytes && *size <= file->bytes - *start;
}

bool exr_join_measure(ExrJoin *join, const ExrFile *file, const RenderSettings *settings,
                      Error *error)
{
    uint64_t start;
    const uint64_t count = tile_count(settings);
    for (uint64_t number = 0; number < count; number++) {
        const Tile tile = tile_at(settings, number);
        if (!find(file, &tile, &start, &join->starts[place_of(file, &tile)]))
            return error_set(error, "it is damaged at pixel %u,%u", tile.x, tile.y);
    }
    return true;
}

bool exr_join_write_head(ExrJoin *join, const ExrFile *file, const Provenance *provenance,
                         FILE *stream)
{
    if (!exr_file_copy_header(file, provenance, stream))
        return false;
    uint64_t next = (uint64_t)ftello(stream) + join->count * sizeof next;
    for (uint64_t place = 0; place < join->count; place++) {
        const uint64_t size = join->starts[place];
        join->starts[place] = next;
        next += size;
    }
    return fwrite(join->starts, sizeof *join->starts, join->count, stream) == join->count &&
           fflush(stream) == 0;
}

bool exr_join_copy(const ExrJoin *join, const ExrFile *file, const RenderSettings *settings,
                   FILE *stream)
{
    const uint64_t count = tile_count(settings);
    for (uint64_t number = 0; number < count; number++) {
        const Tile tile = tile_at(settings, number);
        const uint64_t place = place_of(file, &tile), to = join->starts[place];
        uint64_t start, size;
        errno = 0;
        if (!find(file, &tile, &start, &size) ||
            (place + 1 < join->count && join->starts[place + 1] != to + size) ||
            !exr_file_read(file, start, join->tile, size) ||
            pwrite(fileno(stream), join->tile, size, (off_t)to) != (ssize_t)size)
            return false;
    }
    return true;
}
