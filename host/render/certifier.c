// SPDX-License-Identifier: MIT
// Runs the kernel certify_tile and copies its marks into the map, tile by tile.
#include "render/certifier.h"

#include "render/tile_pass.h"

#include <stdlib.h>
#include <string.h>

// kernels/certify.cl, embedded at build time.
extern const char certify_source[];

bool certifier_check_device(const Device *device, Error *error)
{
    if (!device->facts.fp64)
        return error_set(error, "%s has no double arithmetic, which certainty needs",
                         device->facts.name);
    if (!device->facts.denormals)
        return error_set(error, "%s has no denormal numbers, which certainty needs",
                         device->facts.name);
    return device->facts.correctly_rounded ||
           error_set(error, "%s does not round divisions correctly, which certainty needs",
                     device->facts.name);
}

const KernelEntry certify_entry = {"certify_tile", certify_source, NULL, "bb", .dimensions = 2};

bool certainty_map_make(CertaintyMap *map, uint32_t width, uint32_t height, Error *error)
{
    *map = (CertaintyMap){.width = width, .height = height};
    map->marks = memory_zeroed((size_t)width * height, sizeof *map->marks, error);
    return map->marks != NULL;
}

void certainty_map_free(CertaintyMap *map)
{
    free(map->marks);
    *map = (CertaintyMap){0};
}

static void take_tile(void *context, const Tile *tile, void *const values[2])
{
    const CertifiedPicture *picture = context;
    const float(*colors)[3] = values[0];
    const CertaintyMark *marks = values[1];
    CertaintyMap *map = picture->map;
    float(*pixels)[3] = picture->framebuffer->pixels;
    for (uint32_t row = 0; row < tile->height; row++)
        for (uint32_t column = 0; column < tile->width; column++) {
            const size_t place = (size_t)row * tile->width + column;
            const size_t pixel = (size_t)(tile->top + row) * map->width + tile->left + column;
            map->marks[pixel] = marks[place];
            map->counts[marks[place].certainty]++;
            if (marks[place].certainty == CERTAINTY_REPAIRED)
                memcpy(pixels[pixel], colors[place], sizeof *pixels);
        }
}

bool certifier_certify(const Renderer *renderer, const CameraData *camera,
                       const RenderObserver *observer, const CertifiedPicture *picture,
                       Error *error)
{
    CertifiedPicture target = *picture;
    RenderProgress progress = {.tiles = tile_count(&renderer->settings)};
    const TilePass pass = {.frame = renderer_frame(renderer, camera),
                           .sizes = {sizeof(float[3]), sizeof(CertaintyMark)},
                           .take = take_tile,
                           .context = &target};
    return tile_pass_run(&pass, renderer, observer, &progress, error);
}
