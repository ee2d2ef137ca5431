// SPDX-License-Identifier: MIT
// One pass over the tiles traces the paths, and another counts the tests if a channel needs them.
#include "render/aov_pass.h"

#include "device/buffer.h"

// kernels/aov.cl, embedded at build time.
extern const char aov_source[];

static TilePass path_pass(const AovPass *pass)
{
    TilePass paths = {.kernel = pass->trace_paths,
                      .frame = pass->source->renderer->frame,
                      .outputs = 1,
                      .sizes = {sizeof(PathData)}};
    paths.frame.camera = pass->source->center;
    paths.frame.samples = 1;
    return paths;
}

static TilePass test_pass(const AovPass *pass)
{
    TilePass tests = {.kernel = pass->count_tests,
                      .frame = pass->source->renderer->frame,
                      .outputs = 1,
                      .sizes = {sizeof(uint32_t[TALLY_KINDS])}};
    tests.frame.camera = pass->source->camera;
    return tests;
}

static bool make_kernel(const AovPass *pass, cl_kernel *kernel, const char *name, Error *error)
{
    cl_int status;
    *kernel = clCreateKernel(pass->program.handle, name, &status);
    return cl_succeeded(status, "create a kernel for channels", error);
}

static bool make_kernels(void *context, Error *error)
{
    AovPass *pass = context;
    const Renderer *renderer = pass->source->renderer;
    if (!make_kernel(pass, &pass->trace_paths, "trace_paths", error) ||
        !make_kernel(pass, &pass->count_tests, "count_tests", error))
        return false;
    const TilePass paths = path_pass(pass), tests = test_pass(pass);
    return tile_pass_warm_up(&paths, renderer, error) &&
           (!pass->counts_tests || tile_pass_warm_up(&tests, renderer, error));
}

bool aov_pass_open(AovPass *pass, AovSet set, const AovSource *source, Error *error)
{
    *pass =
        (AovPass){.source = source, .set = set, .counts_tests = aov_needs(set, AOV_NEEDS_TESTS)};
    const SceneTraits traits = traits_general(pass->counts_tests);
    const FirstRun first = {make_kernels, pass};
    RendererSetup setup = *source->setup;
    setup.source.entry = KERNEL_TILE;
    setup.source.appended = aov_source;
    const bool ok = program_make(&pass->program, &setup, &traits, &first, error);
    if (!ok)
        aov_pass_close(pass);
    return ok;
}

void aov_pass_close(AovPass *pass)
{
    device_release_kernel(&pass->trace_paths);
    device_release_kernel(&pass->count_tests);
    program_free(&pass->program);
    *pass = (AovPass){0};
}

static uint32_t samples_of(const AovPass *pass, uint32_t x, uint32_t y)
{
    const AovSource *source = pass->source;
    const RenderSettings *settings = &source->renderer->settings;
    return source->samples != NULL ? source->samples[(size_t)y * settings->width + x]
                                   : settings->samples * settings->samples;
}

static uint32_t certainty_at(const AovPass *pass, uint32_t x, uint32_t y)
{
    const CertaintyMap *map = pass->source->certainty;
    return map != NULL ? map->marks[(size_t)y * map->width + x].certainty : CERTAINTY_OPEN;
}

typedef struct {
    const AovPass *pass;
    Layers *layers;
} Target;

static void take_paths(void *context, const Tile *tile, void *const values[2])
{
    const Target *target = context;
    const AovPass *pass = target->pass;
    const PathData *paths = values[0];
    for (uint32_t row = 0; row < tile->height; row++)
        for (uint32_t column = 0; column < tile->width; column++) {
            const uint32_t x = tile->left + column, y = tile->top + row;
            const AovPixel pixel = {&paths[(size_t)row * tile->width + column],
                                    samples_of(pass, x, y), certainty_at(pass, x, y)};
            aov_take(pass->set, layers_at(target->layers, x, y), &pixel, &pass->source->scene);
        }
}

static void take_tests(void *context, const Tile *tile, void *const values[2])
{
    const Target *target = context;
    const uint32_t(*tests)[TALLY_KINDS] = values[0];
    for (uint32_t row = 0; row < tile->height; row++)
        for (uint32_t column = 0; column < tile->width; column++)
            aov_take_tests(target->pass->set,
                           layers_at(target->layers, tile->left + column, tile->top + row),
                           tests[(size_t)row * tile->width + column]);
}

bool aov_pass_draw(const AovPass *pass, const RenderObserver *observer, Layers *layers,
                   Error *error)
{
    const Renderer *renderer = pass->source->renderer;
    const uint64_t tiles = tile_count(&renderer->settings);
    Target target = {pass, layers};
    TilePass paths = path_pass(pass), tests = test_pass(pass);
    RenderProgress progress = {.tiles = pass->counts_tests ? 2 * tiles : tiles};
    paths.take = take_paths;
    tests.take = take_tests;
    paths.context = tests.context = &target;
    return tile_pass_run(&paths, renderer, observer, &progress, error) &&
           (!pass->counts_tests || progress.tiles_done < tiles ||
            tile_pass_run(&tests, renderer, observer, &progress, error));
}
