// SPDX-License-Identifier: MIT
// libFuzzer target: reads any bytes as an EXR part, as clrt merge does. Reads the settings of the
// part, then each tile twice: without decoding and with decoding. libOpenEXRCore is not
// instrumented, so guard values after the picture detect writes past its end.
#include "demand.h"

#include "image/exr_file.h"
#include "jobs/exr_join.h"
#include "jobs/stored_tiles.h"
#include "render/renderer.h"

#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#define PIXELS_MOST  (1 << 14)
#define TILES_MOST   64
#define BYTES_MOST   ((size_t)1 << 22)
#define GUARD_VALUES 4096
#define GUARD        1234.5f

// Returns memory for `count` values, followed by guard values.
static float *guarded(size_t count)
{
    float *values = malloc((count + GUARD_VALUES) * sizeof *values);
    demand(values != NULL);
    memset(values, 0, count * sizeof *values);
    for (size_t i = 0; i < GUARD_VALUES; i++)
        values[count + i] = GUARD;
    return values;
}

static void check_guards(const float *values, size_t count)
{
    for (size_t i = 0; i < GUARD_VALUES; i++)
        demand(values[count + i] == GUARD);
}

static void read_compressed(const ExrFile *file, const exr_chunk_info_t *tile)
{
    if (tile->packed_size > BYTES_MOST || tile->unpacked_size > BYTES_MOST)
        return;
    unsigned char *bytes = malloc((size_t)tile->packed_size + 1);
    unsigned char *scratch = malloc((size_t)tile->unpacked_size + 1);
    demand(bytes != NULL && scratch != NULL);
    exr_file_read(file, tile, bytes, scratch);
    free(bytes);
    free(scratch);
}

static void read_tiles(const ExrFile *file, const RenderSettings *settings, Layers *layers)
{
    const size_t pixels = (size_t)settings->width * settings->height;
    float *colors = guarded(3 * pixels);
    float *values = guarded(layers->count * pixels);
    layers->values = (uint32_t *)(void *)values;
    const Framebuffer framebuffer = {
        .width = settings->width, .height = settings->height, .pixels = (float(*)[3])colors};
    const uint64_t count = tile_count(settings);
    for (uint64_t number = 0; number < count && number < TILES_MOST; number++) {
        const Tile tile = tile_at(settings, number);
        exr_chunk_info_t found;
        Error error = {0};
        if (!stored_tiles_find(file, &tile, &found, &error)) {
            demand(error.text[0] != '\0');
            continue;
        }
        read_compressed(file, &found);
        const size_t position[2] = {tile.x, tile.y};
        if (found.unpacked_size <= BYTES_MOST)
            exr_file_decode(file, &found, &framebuffer, layers, position);
    }
    check_guards(colors, 3 * pixels);
    check_guards(values, layers->count * pixels);
    free(colors);
    free(values);
}

static void read_part(const ExrFile *file)
{
    StoredTiles tiles;
    Layers layers = {0};
    ExrJoin join = {0};
    Error error = {0};
    if (!stored_tiles_read(&tiles, &file->head))
        return;
    const RenderSettings *settings = &tiles.settings;
    if (settings->tile_width == file->tile_width && settings->tile_height == file->tile_height &&
        (uint64_t)settings->width * settings->height <= PIXELS_MOST &&
        stored_tiles_name_layers(&file->head, &layers)) {
        demand(exr_join_begin(&join, file, &error));
        exr_join_measure(&join, file, settings, &error);
        read_tiles(file, settings, &layers);
        free(join.starts);
    }
    stored_tiles_free(&tiles);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static int memory = -1;
    char path[32];
    ExrFile file;
    Error error = {0};
    if (memory < 0)
        memory = memfd_create("fuzz.exr", MFD_CLOEXEC);
    demand(ftruncate(memory, 0) == 0 && pwrite(memory, data, size, 0) == (ssize_t)size);
    snprintf(path, sizeof path, "/proc/self/fd/%d", memory);
    if (exr_file_open(&file, path, &error))
        read_part(&file);
    else
        demand(error.text[0] != '\0');
    exr_file_close(&file);
    return 0;
}
