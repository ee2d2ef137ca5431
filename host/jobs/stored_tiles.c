// SPDX-License-Identifier: MIT
// Without its entries on tiles, a picture file's settings text identifies the whole picture.
#include "jobs/stored_tiles.h"

#include "cli/options/options.h"
#include "render/renderer.h"

#include <assert.h>
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

static void copy_pixel(const float *values, const uint32_t *places, uint32_t count, float color[3],
                       uint32_t *layers)
{
    for (uint32_t channel = 0; channel < count; channel++)
        if (places[channel] < 3)
            color[places[channel]] = values[channel];
        else if (places[channel] != NOWHERE)
            memcpy(&layers[places[channel] - 3], &values[channel], sizeof *values);
}

void stored_tiles_copy(const RenderSettings *settings, uint64_t count, const StoredImage *image,
                       Framebuffer *framebuffer, Layers *layers)
{
    assert(stored_tiles_has_colors(image));
    uint32_t places[STORED_CHANNELS_MAX];
    find_places(image, layers, places);
    for (uint64_t number = 0; number < count; number++) {
        const Tile tile = tile_at(settings, number);
        for (uint32_t y = tile.y; y < tile.y + tile.height; y++)
            for (uint32_t x = tile.x; x < tile.x + tile.width; x++) {
                const size_t pixel = (size_t)y * image->width + x;
                copy_pixel(image->values + pixel * image->channel_count, places,
                           image->channel_count, framebuffer->pixels[pixel],
                           layers->values + pixel * layers->count);
            }
    }
}
