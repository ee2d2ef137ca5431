// SPDX-License-Identifier: MIT
// clrt merge: joins the parts of a picture. A first pass checks all parts, and a second pass copies
// their tiles into the whole picture. All parts must have the same scene, version, settings and
// channels, and each part must occur once. If can_join() is true, compressed tiles are copied, and
// the picture is never in memory. Otherwise, tiles are decoded into a picture in memory, which is
// allocated after the first pass.
#include "cli/commands.h"

#include "base/output_file.h"
#include "cli/report.h"
#include "jobs/exr_join.h"
#include "jobs/stored_tiles.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    const Options *options;
    Framebuffer framebuffer; // empty if `joins` is true
    Layers layers;
    Provenance provenance; // of the first part, with the devices of all parts
    StoredTiles first;     // settings of the first part that can be opened
    const char *first_path;
    const char **paths; // by part, NULL for a missing part; the array is owned
    bool joins;         // copies compressed tiles into an EXR file instead of decoding them
    ExrJoin join;
    bool is_checked; // the first pass is complete, and no part is missing
    Error unopened;  // the reason why a file cannot be opened; empty if all can
    bool is_damaged; // a part cannot be used
} Merging;

static bool is_picture(const Merging *merging, const StoredTiles *tiles)
{
    const RenderSettings *a = &merging->first.settings, *b = &tiles->settings;
    return json_equal(merging->first.whole, tiles->whole) && a->parts == b->parts &&
           a->tile_width == b->tile_width && a->tile_height == b->tile_height;
}

// Returns the property in which the part differs from the first part, or NULL if they match.
static const char *mismatch_of(const Merging *merging, const StoredTiles *tiles,
                               const StoredImage *image)
{
    static const struct {
        StoredText kind;
        const char *name;
    } equal[] = {{STORED_VERSION, "another version of clrt"},
                 {STORED_MESH_HASH, "another mesh"},
                 {STORED_SCENE_HASH, "another scene"}};
    for (size_t i = 0; i < sizeof equal / sizeof equal[0]; i++)
        if (strcmp(merging->provenance.texts[equal[i].kind], image->texts[equal[i].kind]) != 0)
            return equal[i].name;
    if (!is_picture(merging, tiles))
        return "other settings";
    return stored_tiles_has(image, &merging->layers) ? NULL : "other channels";
}

// Returns whether the list contains the name. The names in the list are separated by "; ".
static bool has_name(const char *list, const char *name)
{
    const size_t length = strlen(name);
    while (strncmp(list, name, length) != 0 ||
           (list[length] != '\0' && strncmp(list + length, "; ", 2) != 0)) {
        list = strstr(list, "; ");
        if (list == NULL)
            return false;
        list += 2;
    }
    return true;
}

// Appends the names of the part's device and driver to the provenance, unless the provenance
// contains these names already.
static void note_device(Merging *merging, const StoredImage *image)
{
    for (int kind = STORED_DEVICE; kind <= STORED_DRIVER; kind++) {
        char *devices = merging->provenance.texts[kind];
        const size_t length = strlen(devices);
        if (!has_name(devices, image->texts[kind]))
            snprintf(devices + length, STORED_TEXT_SIZE - length, "; %s", image->texts[kind]);
    }
}

// Returns whether parts can be joined without decoding their tiles. The output must be an EXR file
// with the parts' tile size, and no hash of the pixels may be requested.
static bool can_join(const Options *options, const ExrFile *file)
{
    return image_format_takes_layers(options->format) && file->tile_width == EXR_TILE &&
           file->tile_height == EXR_TILE && !options->hash;
}

static bool begin(Merging *merging, const StoredTiles *tiles, const ExrFile *file, const char *path,
                  Error *error)
{
    const StoredImage *image = &file->head;
    merging->first = *tiles;
    merging->first_path = path;
    merging->first.whole = json_incref(tiles->whole);
    memcpy(merging->provenance.texts, image->texts, sizeof image->texts);
    merging->paths = memory_zeroed(tiles->settings.parts, sizeof *merging->paths, error);
    if (merging->paths == NULL)
        return false;
    if (!stored_tiles_name_layers(image, &merging->layers))
        return error_set(error, "%s: has channels that clrt does not draw", path);
    merging->joins = can_join(merging->options, file);
    return exr_join_begin(&merging->join, file, error);
}

// In the first pass, records the part's tiles. In the second pass, copies the tiles to `stream`, or
// decodes them if `stream` is NULL.
static bool take_tiles(Merging *merging, const StoredTiles *tiles, const ExrFile *file,
                       FILE *stream, Error *error)
{
    const TileTarget target = {
        .framebuffer = &merging->framebuffer, .layers = &merging->layers, .is_whole = true};
    const RenderSettings *settings = &tiles->settings;
    if (!merging->is_checked)
        return exr_join_measure(&merging->join, file, settings, error);
    return stream != NULL ? exr_join_copy(&merging->join, file, settings, stream, error)
                          : stored_tiles_copy(settings, tile_count(settings), file, &target, error);
}

static bool check_match(const Merging *merging, const StoredTiles *tiles, const StoredImage *image,
                        const char *path, Error *error)
{
    const char *mismatch = mismatch_of(merging, tiles, image);
    return mismatch == NULL ||
           error_set(error, "%s: has %s than %s", path, mismatch, merging->first_path);
}

static bool check_part(Merging *merging, const StoredTiles *tiles, const ExrFile *file,
                       const char *path, Error *error)
{
    const StoredImage *image = &file->head;
    if (strcmp(image->texts[STORED_COMPLETE], "yes") != 0)
        return error_set(error, "%s: part %u of %u was stopped before its end: draw it again", path,
                         tiles->settings.part + 1, tiles->settings.parts);
    if (merging->paths == NULL && !begin(merging, tiles, file, path, error))
        return false;
    if (!check_match(merging, tiles, image, path, error))
        return false;
    const char **place = &merging->paths[tiles->settings.part];
    if (*place != NULL)
        return error_set(error, "%s: is part %u of %u, as is %s", path, tiles->settings.part + 1,
                         tiles->settings.parts, *place);
    *place = path;
    note_device(merging, image);
    return true;
}

static bool read_settings(StoredTiles *tiles, const ExrFile *file, const char *path, Error *error)
{
    return (stored_tiles_read(tiles, &file->head) &&
            tiles->settings.tile_width == file->tile_width &&
            tiles->settings.tile_height == file->tile_height) ||
           error_set(error, "%s: is not a part drawn with --part", path);
}

// Returns whether the file contains the same part as in the first pass.
static bool is_checked_part(const Merging *merging, const StoredTiles *tiles, const ExrFile *file,
                            const char *path, Error *error)
{
    return (tiles->settings.part < merging->first.settings.parts &&
            merging->paths[tiles->settings.part] == path &&
            mismatch_of(merging, tiles, &file->head) == NULL) ||
           error_set(error, "%s: changed while the parts were merged", path);
}

// In the first pass, checks the part and records its tiles. A part that cannot be opened counts as
// missing. In the second pass, copies the part's tiles, and fails if the file has changed.
static bool visit_part(Merging *merging, const char *path, FILE *stream, Error *error)
{
    ExrFile file;
    StoredTiles tiles = {0};
    Error cause = {0};
    const bool opened =
        exr_file_open(&file, path, merging->is_checked ? error : &merging->unopened);
    bool ok = opened ? read_settings(&tiles, &file, path, error) : !merging->is_checked;
    merging->is_damaged |= !ok;
    if (ok && opened) {
        ok = (merging->is_checked ? is_checked_part(merging, &tiles, &file, path, error)
                                  : check_part(merging, &tiles, &file, path, error)) &&
             take_tiles(merging, &tiles, &file, stream, &cause);
        merging->is_damaged = !ok && merging->join.write_error == 0;
        if (merging->is_damaged)
            error_set(error, "%s: part %u of %u cannot be used: %s", path, tiles.settings.part + 1,
                      tiles.settings.parts, cause.text);
    }
    stored_tiles_free(&tiles);
    exr_file_close(&file);
    return ok;
}

// Fails if parts are missing or a file could not be opened. The message lists the missing parts in
// the syntax of a job array, such as 1,3.
static bool check_missing(const Merging *merging, Error *error)
{
    char list[1024] = "";
    uint32_t missing = 0;
    const uint32_t parts = merging->first.settings.parts;
    const char *cause = merging->unopened.text, *colon = cause[0] == '\0' ? "" : ": ";
    for (uint32_t part = 0; part < parts; part++) {
        const size_t length = strlen(list);
        if (merging->paths[part] == NULL && length + 12 < sizeof list)
            snprintf(list + length, sizeof list - length, "%s%u", missing++ > 0 ? "," : "",
                     part + 1);
    }
    if (missing == 0 && cause[0] == '\0')
        return true;
    return missing == 0 ? error_set(error, "%s", cause)
                        : error_set(error, "part%s %s of %u %s missing%s%s", missing > 1 ? "s" : "",
                                    list, parts, missing > 1 ? "are" : "is", colon, cause);
}

static bool visit_parts(Merging *merging, FILE *stream, Error *error)
{
    const Options *options = merging->options;
    for (int i = 0; i < options->part_count; i++)
        if (!visit_part(merging, options->part_paths[i], stream, error))
            return false;
    return true;
}

typedef struct {
    Merging *merging;
    const ImageSettings *settings;
    Error *error; // receives faults of parts
} Joining;

// Writes the joined picture. If a part cannot be used, returns false and sets errno to 0.
static bool write_joined(void *context, FILE *stream, Error *cause)
{
    Joining *joining = context;
    Merging *merging = joining->merging;
    (void)cause;
    if (!exr_join_write_head(&merging->join, joining->settings, &merging->first.settings, stream))
        return false;
    const bool ok = visit_parts(merging, stream, joining->error);
    errno = merging->join.write_error;
    return ok;
}

static bool decode(Merging *merging, Error *error)
{
    const RenderSettings *settings = &merging->first.settings;
    return framebuffer_make(&merging->framebuffer, settings->width, settings->height, error) &&
           layers_make(&merging->layers, settings->width, settings->height, error) &&
           visit_parts(merging, NULL, error);
}

static bool write_whole(Merging *merging, Error *error)
{
    const Options *options = merging->options;
    const RenderSettings *place = &merging->first.settings;
    Provenance *provenance = &merging->provenance;
    provenance_write_settings(provenance->texts[STORED_SETTINGS], merging->first.whole);
    if (!merging->joins)
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
    Joining joining = {merging, &settings, error};
    if (merging->joins)
        return output_file_write(options->output_path, write_joined, &joining, error);
    return image_write(&merging->framebuffer, options->output_path, &settings, error);
}

static ExitCode run(Merging *merging, Error *error)
{
    const Options *options = merging->options;
    if (!provenance_check_date(error))
        return EXIT_USAGE;
    if (!output_file_check(options->output_path, error))
        return EXIT_OUTPUT;
    if (!visit_parts(merging, NULL, error) || !check_missing(merging, error))
        return EXIT_SCENE;
    if (merging->layers.count > 0 && !image_format_takes_layers(options->format)) {
        error_set(error,
                  "the parts have channels, which the format %s cannot store: give -o FILE.exr",
                  options->format);
        return EXIT_USAGE;
    }
    merging->is_checked = true;
    if (!merging->joins && !decode(merging, error))
        return EXIT_SCENE;
    if (!write_whole(merging, error))
        return merging->is_damaged ? EXIT_SCENE : EXIT_OUTPUT;
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
    free(merging.join.starts);
    free(merging.paths);
    return outcome;
}
