// SPDX-License-Identifier: MIT
// A pass over the tiles traces the paths. If a channel needs counts of tests, another pass counts
// the tests.
#include "render/aov_pass.h"

#include "render/tile_pass.h"

// kernels/aov.cl, embedded at build time.
extern const char aov_source[];

const KernelEntry paths_entry = {"trace_paths", aov_source, NULL, "b", .dimensions = 2};
const KernelEntry tests_entry = {"count_tests", aov_source, NULL, "b", .dimensions = 2};

static uint32_t samples_of(const AovPass *pass, uint32_t x, uint32_t y)
{
    const RenderSettings *settings = &pass->paths.settings;
    return pass->samples != NULL ? pass->samples[(size_t)y * settings->width + x]
                                 : settings->samples * settings->samples;
}

static uint32_t certainty_at(const AovPass *pass, uint32_t x, uint32_t y)
{
    const CertaintyMap *map = pass->certainty;
    return map != NULL ? map->marks[(size_t)y * map->width + x].certainty : CERTAINTY_OPEN;
}

typedef struct {
    const AovPass *pass;
    Layers *layers;
} PassTarget;

static void take_paths(void *context, const Tile *tile, void *const values[2])
{
    const PassTarget *target = context;
    const AovPass *pass = target->pass;
    const PathData *paths = values[0];
    for (uint32_t row = 0; row < tile->height; row++)
        for (uint32_t column = 0; column < tile->width; column++) {
            const uint32_t x = tile->left + column, y = tile->top + row;
            const AovPixel pixel = {&paths[(size_t)row * tile->width + column],
                                    samples_of(pass, x, y), certainty_at(pass, x, y)};
            aov_take(pass->set, layers_at(target->layers, x, y), &pixel, &pass->scene);
        }
}

static void take_tests(void *context, const Tile *tile, void *const values[2])
{
    const PassTarget *target = context;
    const uint32_t(*tests)[TALLY_KINDS] = values[0];
    for (uint32_t row = 0; row < tile->height; row++)
        for (uint32_t column = 0; column < tile->width; column++)
            aov_take_tests(target->pass->set,
                           layers_at(target->layers, tile->left + column, tile->top + row),
                           tests[(size_t)row * tile->width + column]);
}

static bool draw_paths(PassTarget *target, const RenderObserver *observer, RenderProgress *progress,
                       Error *error)
{
    const AovPass *pass = target->pass;
    TilePass paths = {.frame = renderer_frame(&pass->paths, &pass->center),
                      .sizes = {sizeof(PathData)},
                      .take = take_paths,
                      .context = target};
    paths.frame.samples = 1;
    return tile_pass_run(&paths, &pass->paths, observer, progress, error);
}

static bool draw_tests(PassTarget *target, const RenderObserver *observer, RenderProgress *progress,
                       Error *error)
{
    const AovPass *pass = target->pass;
    Renderer renderer = pass->paths;
    renderer.kernel = pass->tests;
    const TilePass tests = {.frame = renderer_frame(&renderer, &pass->camera),
                            .sizes = {sizeof(uint32_t[TALLY_KINDS])},
                            .take = take_tests,
                            .context = target};
    return tile_pass_run(&tests, &renderer, observer, progress, error);
}

bool aov_pass_draw(const AovPass *pass, const RenderObserver *observer, Layers *layers,
                   Error *error)
{
    const uint64_t tiles = tile_count(&pass->paths.settings);
    PassTarget target = {pass, layers};
    RenderProgress progress = {.tiles = pass->tests != NULL ? 2 * tiles : tiles};
    return draw_paths(&target, observer, &progress, error) &&
           (pass->tests == NULL || progress.tiles_done < tiles ||
            draw_tests(&target, observer, &progress, error));
}
