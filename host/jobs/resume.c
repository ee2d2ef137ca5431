// SPDX-License-Identifier: MIT
// Each record of a picture's journal contains the colors of one finished tile. Tiles finish in the
// order of their numbers, so the number of records identifies the finished tiles. The journal's key
// is a hash of everything that determines the picture and its tiles. A resumed picture therefore
// has the same bits as an uninterrupted one.
#include "jobs/resume.h"

#include "base/text.h"
#include "jobs/stored_tiles.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

char *resume_journal_name(const char *output_path, Error *error)
{
    return text_format(error, "%s.part", output_path);
}

bool resume_prepare(Resume *resume, const char *path, bool is_exr, Error *error)
{
    struct stat status;
    const bool exists = lstat(path, &status) == 0;
    if (exists && !S_ISREG(status.st_mode))
        return error_set(error, "%s: cannot be resumed: not a regular file", path);
    resume->path = resume_journal_name(path, error);
    if (resume->path == NULL)
        return false;
    resume->stored_path = is_exr ? path : NULL;
    return true;
}

static void make_key(const Provenance *own, const RenderSettings *settings, uint64_t key[2])
{
    char text[STORED_TEXTS * STORED_TEXT_SIZE];
    const int length =
        snprintf(text, sizeof text, "%s\n%s\n%s\n%s\n%ux%u", own->texts[STORED_VERSION],
                 own->texts[STORED_SCENE_HASH], own->texts[STORED_MESH_HASH],
                 own->texts[STORED_SETTINGS], settings->tile_width, settings->tile_height);
    const XXH128_hash_t hash = XXH3_128bits(text, (size_t)length);
    key[0] = hash.low64;
    key[1] = hash.high64;
}

static bool is_same_picture(const StoredImage *stored, const Provenance *own,
                            const RenderSettings *settings)
{
    static const StoredText kinds[] = {STORED_VERSION, STORED_SCENE_HASH, STORED_MESH_HASH,
                                       STORED_SETTINGS};
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++)
        if (strcmp(stored->texts[kinds[i]], own->texts[kinds[i]]) != 0)
            return false;
    return stored->width == settings->width && stored->height == settings->height &&
           stored_tiles_has_colors(stored);
}

static bool take_stored(const Resume *resume, const Provenance *own, RenderSettings *settings,
                        Framebuffer *framebuffer, Error *error)
{
    Layers none = {0};
    const ExrFile *file = &resume->stored;
    RenderSettings stored = *settings;
    if (settings->parts == 0)
        stored.tile_width = stored.tile_height = EXR_TILE;
    if (!is_same_picture(&file->head, own, settings) || file->tile_width != stored.tile_width ||
        file->tile_height != stored.tile_height)
        return error_set(error,
                         "%s: belongs to another scene, other settings or another version of clrt: "
                         "remove it to begin again",
                         resume->stored_path);
    Error cause = {0};
    const TileTarget target = {.framebuffer = framebuffer, .layers = &none};
    settings->ready_tiles = tile_count(settings);
    return stored_tiles_copy(&stored, tile_count(&stored), file, &target, &cause) ||
           error_set(error, "%s: cannot be resumed: %s", resume->stored_path, cause.text);
}

static size_t tile_size(const Tile *tile)
{
    return (size_t)tile->width * tile->height * sizeof(float[3]);
}

static void copy_tile(float *values, const Framebuffer *framebuffer, const Tile *tile, bool is_kept)
{
    const size_t size = tile->width * sizeof(float[3]);
    for (uint32_t row = 0; row < tile->height; row++) {
        float *there = values + (size_t)row * tile->width * 3;
        float *here =
            framebuffer->pixels[(size_t)(tile->top + row) * framebuffer->width + tile->left];
        memcpy(is_kept ? there : here, is_kept ? here : there, size);
    }
}

static void read_journal(Resume *resume, RenderSettings *settings, const Framebuffer *framebuffer)
{
    const uint64_t tiles = tile_count(settings);
    while (settings->ready_tiles < tiles) {
        const Tile tile = tile_at(settings, settings->ready_tiles);
        if (!journal_read(&resume->journal, resume->tile, tile_size(&tile)))
            return;
        copy_tile(resume->tile, framebuffer, &tile, false);
        settings->ready_tiles++;
    }
}

// Copies the tiles of a complete EXR file into `framebuffer`. Requires the journal's lock, because
// another run might be about to write the file. Ignores an incomplete EXR file.
static bool restore_stored(Resume *resume, const Provenance *own, RenderSettings *settings,
                           Framebuffer *framebuffer, Error *error)
{
    if (resume->stored_path == NULL || access(resume->stored_path, F_OK) != 0)
        return true;
    bool ok = exr_file_open(&resume->stored, resume->stored_path, error);
    if (ok && strcmp(resume->stored.head.texts[STORED_COMPLETE], "no") != 0)
        ok = take_stored(resume, own, settings, framebuffer, error);
    exr_file_close(&resume->stored);
    return ok;
}

static bool restore_tiles(Resume *resume, const Provenance *own, RenderSettings *settings,
                          Framebuffer *framebuffer, Error *error)
{
    uint64_t key[2];
    make_key(own, settings, key);
    if (!journal_open(&resume->journal, resume->path, key, error))
        return false;
    read_journal(resume, settings, framebuffer);
    if (settings->ready_tiles == 0 && !restore_stored(resume, own, settings, framebuffer, error)) {
        journal_close(&resume->journal, true); // deletes the journal, which has no tiles
        return false;
    }
    return journal_claim(&resume->journal, error);
}

bool resume_open(Resume *resume, const Provenance *own, RenderSettings *settings,
                 Framebuffer *framebuffer, Error *error)
{
    const Tile largest = tile_largest(settings);
    if (resume->path == NULL)
        return true;
    resume->tile = memory_raw(tile_size(&largest), 1, error);
    return resume->tile != NULL && restore_tiles(resume, own, settings, framebuffer, error);
}

bool resume_keep(Resume *resume, const RenderSettings *settings, const Framebuffer *framebuffer,
                 uint64_t number, Error *error)
{
    if (resume->path == NULL)
        return true;
    const Tile tile = tile_at(settings, number);
    copy_tile(resume->tile, framebuffer, &tile, true);
    return journal_add(&resume->journal, resume->tile, tile_size(&tile), error);
}

void resume_close(Resume *resume, bool is_done)
{
    journal_close(&resume->journal, is_done);
    free(resume->tile);
    free(resume->path);
    *resume = (Resume){0};
}
