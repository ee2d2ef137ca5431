// SPDX-License-Identifier: MIT
// Reads the parts one after another and copies their tiles into the whole picture. The parts must
// have the same scene, version and settings, and each part must occur once.
#include "cli/commands.h"

#include "base/output_file.h"
#include "cli/report.h"
#include "image/stored_image.h"
#include "jobs/stored_tiles.h"
#include "render/renderer.h"

#include <stdlib.h>
#include <string.h>

typedef struct {
    const Options *options;
    Framebuffer framebuffer;
    Layers layers;
    Provenance provenance; // the first part's, with the devices of all parts
    StoredTiles first;     // of the first part
    const char **paths;    // paths[i] names part i, or is NULL if the part is missing; the array is
    // owned
} Merging;

static bool is_picture(const Merging *merging, const StoredTiles *tiles)
{
    const RenderSettings *a = &merging->first.settings, *b = &tiles->settings;
    return json_equal(merging->first.whole, tiles->whole) && a->parts == b->parts &&
           a->tile_width == b->tile_width && a->tile_height == b->tile_height;
}

// Returns the property in which the part differs from the first one; NULL if they match.
static const char *mismatch_of(const Merging *merging, const StoredTiles *tiles,
                               const StoredImage *image)
{
    static const struct {
        StoredText kind;
        const char *name;
    } equal[] = {{STORED_VERSION, "version of clrt"},
                 {STORED_MESH_HASH, "mesh"},
                 {STORED_SCENE_HASH, "scene"}};
    for (size_t i = 0; i < sizeof equal / sizeof equal[0]; i++)
        if (strcmp(merging->provenance.texts[equal[i].kind], image->texts[equal[i].kind]) != 0)
            return equal[i].name;
    if (!is_picture(merging, tiles))
        return "set of settings";
    return stored_tiles_has(image, &merging->layers) ? NULL : "set of channels";
}

static bool note_part(Merging *merging, const StoredTiles *tiles, const char *path, Error *error)
{
    const char **place = &merging->paths[tiles->settings.part];
    if (*place != NULL)
        return error_set(error, "%s: is part %u of %u, which %s is already", path,
                         tiles->settings.part + 1, tiles->settings.parts, *place);
    *place = path;
    return true;
}

// Adds the part's device and driver unless another part has the same.
static void note_device(Merging *merging, const StoredImage *image)
{
    for (int kind = STORED_DEVICE; kind <= STORED_DRIVER; kind++) {
        char *devices = merging->provenance.texts[kind];
        const size_t length = strlen(devices);
        if (strstr(devices, image->texts[kind]) == NULL)
            snprintf(devices + length, STORED_TEXT_SIZE - length, "; %s", image->texts[kind]);
    }
}

static bool begin(Merging *merging, const StoredTiles *tiles, const StoredImage *image,
                  const char *path, Error *error)
{
    merging->first = *tiles;
    merging->first.whole = json_incref(tiles->whole);
    memcpy(merging->provenance.texts, image->texts, sizeof image->texts);
    merging->paths = memory_zeroed(tiles->settings.parts, sizeof *merging->paths, error);
    if (merging->paths == NULL)
        return false;
    if (!stored_tiles_name_layers(image, &merging->layers))
        return error_set(error, "%s: has channels that clrt does not draw", path);
    return framebuffer_make(&merging->framebuffer, image->width, image->height, error) &&
           layers_make(&merging->layers, image->width, image->height, error);
}

static bool take(Merging *merging, const StoredTiles *tiles, const StoredImage *image,
                 const char *path, Error *error)
{
    if (strcmp(image->texts[STORED_COMPLETE], "yes") != 0)
        return error_set(error, "%s: was stopped before its end", path);
    if (merging->paths == NULL && !begin(merging, tiles, image, path, error))
        return false;
    const char *mismatch = mismatch_of(merging, tiles, image);
    if (mismatch != NULL)
        return error_set(error, "%s: is of another %s than %s", path, mismatch,
                         merging->options->part_paths[0]);
    if (!note_part(merging, tiles, path, error))
        return false;
    note_device(merging, image);
    stored_tiles_copy(&tiles->settings, tile_count(&tiles->settings), image, &merging->framebuffer,
                      &merging->layers);
    return true;
}

static bool read_part(Merging *merging, const char *path, Error *error)
{
    StoredImage image;
    StoredTiles tiles = {0};
    if (!image_read(&image, path, error))
        return false;
    const bool ok = stored_tiles_read(&tiles, &image)
                        ? take(merging, &tiles, &image, path, error)
                        : error_set(error, "%s: is no part of a picture that --part drew", path);
    stored_tiles_free(&tiles);
    stored_image_free(&image);
    return ok;
}

static bool read_parts(Merging *merging, Error *error)
{
    const Options *options = merging->options;
    for (int i = 0; i < options->part_count; i++)
        if (!read_part(merging, options->part_paths[i], error))
            return false;
    const uint32_t parts = merging->first.settings.parts;
    for (uint32_t part = 0; part < parts; part++)
        if (merging->paths[part] == NULL)
            return error_set(error, "part %u of %u is missing", part + 1, parts);
    return true;
}

static bool write_whole(Merging *merging, Error *error)
{
    const Options *options = merging->options;
    const RenderSettings *place = &merging->first.settings;
    Provenance *provenance = &merging->provenance;
    provenance_write_settings(provenance->texts[STORED_SETTINGS], merging->first.whole);
    framebuffer_hash(&merging->framebuffer, provenance->texts[STORED_PIXEL_HASH]);
    provenance_list(provenance);
    const ImageSettings settings = {
        .format = options->format,
        .encoding = merging->first.encoding,
        .texts = provenance->list,
        .text_count = options->no_metadata ? 0 : provenance->count,
        .left = place->left,
        .top = place->top,
        .whole_width = place->whole_width,
        .whole_height = place->whole_height,
        .layers = merging->layers.count > 0 ? &merging->layers : NULL,
    };
    return image_write(&merging->framebuffer, options->output_path, &settings, error);
}

static ExitCode run(Merging *merging, Error *error)
{
    const Options *options = merging->options;
    if (!provenance_check_date(error))
        return EXIT_USAGE;
    if (!output_file_check(options->output_path, error))
        return EXIT_OUTPUT;
    if (!read_parts(merging, error))
        return EXIT_SCENE;
    if (merging->layers.count > 0 && !image_format_takes_layers(options->format)) {
        error_set(error, "the parts have channels, which %s does not hold: give -o FILE.exr",
                  options->format);
        return EXIT_USAGE;
    }
    if (!write_whole(merging, error))
        return EXIT_OUTPUT;
    const char *hash = merging->provenance.texts[STORED_PIXEL_HASH];
    return report_print_hash(options, hash, error) ? EXIT_DONE : EXIT_FAULTS;
}

ExitCode merge_parts(const Options *options, Error *error)
{
    Merging merging = {.options = options};
    const ExitCode outcome = run(&merging, error);
    framebuffer_free(&merging.framebuffer);
    layers_free(&merging.layers);
    stored_tiles_free(&merging.first);
    free(merging.paths);
    return outcome;
}
