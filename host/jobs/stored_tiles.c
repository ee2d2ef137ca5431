// SPDX-License-Identifier: MIT
// Reads the settings of an EXR file and copies its tiles. The files of a picture's parts store
// equal settings, except for the entries `part` and `tile`.
#include "jobs/stored_tiles.h"

#include "base/thread_pool.h"
#include "session/picture.h"

#include <assert.h>
#include <pthread.h>
#include <string.h>

static bool in_range(int value, int least, int most)
{
    return value >= least && value <= most;
}

static bool read_part(RenderSettings *settings, json_t *json)
{
    int part, parts, tile[2];
    if (json_unpack(json, "{s:[ii], s:[ii]}", "part", &part, &parts, "tile", &tile[0], &tile[1]) !=
            0 ||
        !in_range(parts, 1, PARTS_MAX) || !in_range(part, 1, parts) ||
        !in_range(tile[0], 1, PICTURE_SIZE_MAX) || !in_range(tile[1], 1, PICTURE_SIZE_MAX))
        return false;
    settings->part = (uint32_t)part - 1;
    settings->parts = (uint32_t)parts;
    settings->tile_width = (uint32_t)tile[0];
    settings->tile_height = (uint32_t)tile[1];
    return true;
}

// Reads the size of the whole picture, and its crop. Fails unless the crop has the image's size and
// is inside the whole picture.
static bool read_place(RenderSettings *settings, json_t *json)
{
    int width, height, edges[4] = {0};
    if (json_unpack(json, "{s:i, s:i}", "width", &width, "height", &height) != 0 ||
        !in_range(width, 1, PICTURE_SIZE_MAX) || !in_range(height, 1, PICTURE_SIZE_MAX))
        return false;
    edges[2] = width;
    edges[3] = height;
    json_t *crop = json_object_get(json, "crop");
    if (crop != NULL &&
        json_unpack(crop, "[iiii]", &edges[0], &edges[1], &edges[2], &edges[3]) != 0)
        return false;
    settings->left = (uint32_t)edges[0];
    settings->top = (uint32_t)edges[1];
    settings->whole_width = (uint32_t)width;
    settings->whole_height = (uint32_t)height;
    return in_range(edges[0], 0, width - 1) && in_range(edges[1], 0, height - 1) &&
           in_range(edges[2], 1, width) && in_range(edges[3], 1, height) &&
           edges[2] - edges[0] == (int)settings->width &&
           edges[3] - edges[1] == (int)settings->height;
}

bool stored_tiles_read(StoredTiles *tiles, const StoredImage *image)
{
    const char *encoding = "raw";
    *tiles = (StoredTiles){.settings = {.width = image->width, .height = image->height},
                           .whole = json_loads(image->texts[STORED_SETTINGS], 0, NULL)};
    if (tiles->whole == NULL || !read_part(&tiles->settings, tiles->whole) ||
        !read_place(&tiles->settings, tiles->whole)) {
        stored_tiles_free(tiles);
        return false;
    }
    json_unpack(tiles->whole, "{s:s}", "encode", &encoding);
    tiles->encoding = strcmp(encoding, "srgb") == 0 ? ENCODE_SRGB : ENCODE_RAW;
    json_object_del(tiles->whole, "part");
    json_object_del(tiles->whole, "tile");
    return true;
}

void stored_tiles_free(StoredTiles *tiles)
{
    json_decref(tiles->whole);
    *tiles = (StoredTiles){0};
}

static const char *const color_names[3] = {"R", "G", "B"};

static bool is_color(const char *name)
{
    return name[0] != '\0' && name[1] == '\0' && strchr("RGB", name[0]) != NULL;
}

bool stored_tiles_name_layers(const StoredImage *image, Layers *layers)
{
    Layers known = {0};
    aov_name_layers((AovSet)(((uint64_t)1 << aov_count) - 1), &known);
    for (uint32_t channel = 0; channel < image->channel_count; channel++) {
        uint32_t place = 0;
        if (is_color(image->names[channel]))
            continue;
        while (place < known.count && strcmp(known.list[place].name, image->names[channel]) != 0)
            place++;
        if (place == known.count)
            return false;
        layers->list[layers->count++] = known.list[place];
    }
    return stored_tiles_has(image, layers);
}

bool stored_tiles_has_colors(const StoredImage *image)
{
    bool has = true;
    for (int color = 0; color < 3; color++)
        has = has && stored_image_channel(image, color_names[color]) >= 0;
    return has;
}

bool stored_tiles_has(const StoredImage *image, const Layers *layers)
{
    bool has = image->channel_count == 3 + layers->count && stored_tiles_has_colors(image);
    for (uint32_t layer = 0; layer < layers->count; layer++)
        has = has && stored_image_channel(image, layers->list[layer].name) >= 0;
    return has;
}

bool stored_tiles_list(const RenderSettings *settings, ImagePart *part, Error *error)
{
    *part = (ImagePart){.width = settings->width,
                        .height = settings->height,
                        .tile_width = settings->tile_width,
                        .tile_height = settings->tile_height,
                        .tile_count = tile_count(settings)};
    part->tiles = memory_raw(part->tile_count, sizeof *part->tiles, error);
    for (size_t number = 0; part->tiles != NULL && number < part->tile_count; number++) {
        const Tile tile = tile_at(settings, number);
        part->tiles[number][0] = tile.x;
        part->tiles[number][1] = tile.y;
    }
    return part->tiles != NULL;
}

typedef struct {
    const RenderSettings *settings;
    TileWork *work;
    const void *context;
    pthread_mutex_t lock; // protects `failed` and `error`
    uint32_t failed;      // the lowest number of a failed tile; UINT32_MAX if none has failed
    Error *error;
} TileRun;

static void run_tile(void *context, uint32_t number)
{
    TileRun *run = context;
    Error error = {0};
    const Tile tile = tile_at(run->settings, number);
    if (run->work(run->context, &tile, &error))
        return;
    pthread_mutex_lock(&run->lock);
    if (number < run->failed) {
        run->failed = number;
        *run->error = error;
    }
    pthread_mutex_unlock(&run->lock);
}

bool stored_tiles_run(const RenderSettings *settings, uint64_t count, TileWork *work,
                      const void *context, Error *error)
{
    assert(count < UINT32_MAX);
    ThreadPool *pool = thread_pool_open(0);
    TileRun run = {settings, work, context, PTHREAD_MUTEX_INITIALIZER, UINT32_MAX, error};
    thread_pool_run(pool, (uint32_t)count, run_tile, &run);
    thread_pool_close(pool);
    return run.failed == UINT32_MAX;
}

bool stored_tiles_find(const ExrFile *file, const Tile *tile, exr_chunk_info_t *found, Error *error)
{
    return exr_file_find(file, tile->x / file->tile_width, tile->y / file->tile_height, found) ||
           error_set(error, "it is damaged at pixel %u,%u", tile->x, tile->y);
}

typedef struct {
    const ExrFile *file;
    const TileTarget *target;
} TileCopy;

static bool copy_tile(const void *context, const Tile *tile, Error *error)
{
    const TileCopy *copy = context;
    const TileTarget *target = copy->target;
    size_t position[2] = {target->is_whole ? tile->x : tile->left,
                          target->is_whole ? tile->y : tile->top};
    exr_chunk_info_t found;
    return stored_tiles_find(copy->file, tile, &found, error) &&
           (exr_file_decode(copy->file, &found, target->framebuffer, target->layers, position) ||
            error_set(error, "it is damaged at pixel %u,%u", tile->x, tile->y));
}

bool stored_tiles_copy(const RenderSettings *settings, uint64_t count, const ExrFile *file,
                       const TileTarget *target, Error *error)
{
    const TileCopy copy = {file, target};
    return stored_tiles_run(settings, count, copy_tile, &copy, error);
}
