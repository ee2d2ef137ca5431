// SPDX-License-Identifier: MIT
// Without its entries on tiles, a picture file's settings text identifies the whole picture.
#include "jobs/stored_tiles.h"

#include "cli/options/options.h"
#include "render/renderer.h"

#include <assert.h>
#include <stdlib.h>
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

// The crop must have the image's size and lie inside the whole picture.
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

// Removes the tile entries from the settings.
static void strip(json_t *json)
{
    json_object_del(json, "tile");
    json_object_del(json, "tiles_done");
}

// Stores the number of finished tiles. The tile sizes must match unless the stored picture is
// complete and not a part.
static bool count_done(const StoredImage *image, json_t *json, const RenderSettings *settings,
                       uint64_t *tiles)
{
    const bool is_whole = strcmp(image->texts[STORED_COMPLETE], "yes") == 0;
    int tile[2] = {(int)settings->tile_width, (int)settings->tile_height};
    json_int_t done = (json_int_t)tile_count(settings);
    *tiles = tile_count(settings);
    if ((!is_whole || settings->parts > 0) &&
        json_unpack(json, "{s:[ii]}", "tile", &tile[0], &tile[1]) != 0)
        return false;
    if (!is_whole && json_unpack(json, "{s:I}", "tiles_done", &done) != 0)
        return false;
    if (done < 0 || (uint64_t)done > *tiles)
        return false;
    *tiles = (uint64_t)done;
    return tile[0] == (int)settings->tile_width && tile[1] == (int)settings->tile_height;
}

bool stored_tiles_done(const StoredImage *image, const char *settings_text,
                       const RenderSettings *settings, uint64_t *tiles)
{
    json_t *stored = json_loads(image->texts[STORED_SETTINGS], 0, NULL);
    json_t *own = json_loads(settings_text, 0, NULL);
    bool ok = stored != NULL && own != NULL && count_done(image, stored, settings, tiles);
    if (ok) {
        strip(stored);
        strip(own);
        ok = json_equal(stored, own) != 0;
    }
    json_decref(stored);
    json_decref(own);
    return ok;
}

void stored_tiles_free(StoredTiles *tiles)
{
    json_decref(tiles->whole);
    *tiles = (StoredTiles){0};
}

#define NOWHERE UINT32_MAX

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

// Maps each channel to 0 to 2 for a color, 3 + i for layer i, or NOWHERE.
static void find_places(const StoredImage *image, const Layers *layers, uint32_t *places)
{
    for (uint32_t channel = 0; channel < image->channel_count; channel++)
        places[channel] = NOWHERE;
    for (uint32_t color = 0; color < 3; color++)
        places[stored_image_channel(image, color_names[color])] = color;
    for (uint32_t layer = 0; layer < layers->count; layer++)
        places[stored_image_channel(image, layers->list[layer].name)] = 3 + layer;
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

// Copies one channel of a tile into the colors or a layer.
static void copy_channel(const uint32_t *values, const Tile *tile, uint32_t place,
                         const TileTarget *target)
{
    Framebuffer *framebuffer = target->framebuffer;
    const Layers *layers = target->layers;
    const uint32_t left = target->is_whole ? tile->x : tile->left;
    const uint32_t top = target->is_whole ? tile->y : tile->top;
    for (uint32_t row = 0; row < tile->height; row++)
        for (uint32_t column = 0; place != NOWHERE && column < tile->width; column++) {
            const size_t pixel = (size_t)(top + row) * framebuffer->width + left + column;
            const uint32_t *value = &values[(size_t)row * target->pitch + column];
            if (place < 3)
                memcpy(&framebuffer->pixels[pixel][place], value, sizeof *value);
            else
                layers->values[pixel * layers->count + place - 3] = *value;
        }
}

static bool copy_tile(const ExrFile *file, const Tile *tile, uint32_t *const memory[2],
                      const TileTarget *target)
{
    uint64_t start;
    ExrTileHead head;
    TileTarget own = *target;
    uint32_t places[STORED_CHANNELS_MAX];
    const size_t size = exr_tile_bytes(file, tile->width, tile->height);
    if (!exr_file_find(file, tile->x / file->tile_width, tile->y / file->tile_height, &start,
                       &head) ||
        !exr_file_unpack(file, start, &head, (unsigned char *)memory[0], memory[1], size))
        return false;
    find_places(&file->head, target->layers, places);
    own.pitch = (size_t)tile->width * file->head.channel_count;
    for (uint32_t channel = 0; channel < file->head.channel_count; channel++)
        copy_channel(memory[1] + (size_t)channel * tile->width, tile, places[channel], &own);
    return true;
}

bool stored_tiles_copy(const RenderSettings *settings, uint64_t count, const ExrFile *file,
                       const TileTarget *target, Error *error)
{
    assert(stored_tiles_has_colors(&file->head));
    const Tile largest = tile_largest(settings);
    const size_t size = exr_tile_bytes(file, largest.width, largest.height);
    uint32_t *const memory[2] = {memory_raw(size, 1, error), memory_raw(size, 1, error)};
    bool ok = memory[0] != NULL && memory[1] != NULL;
    for (uint64_t number = 0; ok && number < count; number++) {
        const Tile tile = tile_at(settings, number);
        ok = copy_tile(file, &tile, memory, target) ||
             error_set(error, "it is damaged at pixel %u,%u", tile.x, tile.y);
    }
    free(memory[0]);
    free(memory[1]);
    return ok;
}
