// SPDX-License-Identifier: MIT
// Draws a picture's colors by a pass over its tiles, and adds up the tiles' counts.
#include "render/draw.h"

#include "render/tile_pass.h"

// kernels/tile.cl, embedded at build time.
extern const char tile_source[];

const KernelEntry draw_entry = {"render_tile", tile_source, NULL, "bb", .dimensions = 2};

static void take_tallies(void *context, const Tile *tile, void *const values[2])
{
    renderer_add_tallies(context, values[1], (size_t)tile->width * tile->height);
}

static bool check_size(const Renderer *renderer, const Framebuffer *framebuffer, Error *error)
{
    uint32_t width, height;
    tile_frame_size(&renderer->settings, &width, &height);
    return (framebuffer->width == width && framebuffer->height == height) ||
           error_set(error, "the picture has %u x %u pixels, and the framebuffer %u x %u", width,
                     height, framebuffer->width, framebuffer->height);
}

bool renderer_draw(Renderer *renderer, const CameraData *camera, const RenderObserver *observer,
                   Framebuffer *framebuffer, Error *error)
{
    if (!check_size(renderer, framebuffer, error))
        return false;
    const size_t kinds = TALLY_KINDS - renderer_first_tally(renderer);
    const TilePass pass = {.frame = renderer_frame(renderer, camera),
                           .sizes = {sizeof(float[3]), kinds * sizeof(uint32_t)},
                           .first = renderer->settings.ready_tiles,
                           .framebuffer = framebuffer,
                           .take = take_tallies,
                           .context = renderer};
    renderer->progress = (RenderProgress){.tiles_done = pass.first,
                                          .tiles = tile_count(&renderer->settings),
                                          .tiles_ready = pass.first};
    return tile_pass_run(&pass, renderer, observer, &renderer->progress, error);
}
