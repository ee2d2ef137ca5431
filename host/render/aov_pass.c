// SPDX-License-Identifier: MIT
// Traces one tile at a time. Two at a time, as in the picture, would gain little: most channels
// take about as long as one sample per pixel.
#include "render/aov_pass.h"

#include "device/buffer.h"
#include "render/renderer.h"

#include <stdlib.h>

// kernels/aov.cl, embedded at build time.
extern const char aov_source[];

static bool run_kernel(const AovPass *pass, cl_kernel kernel, const FrameData *frame, cl_mem output,
                       Error *error)
{
    const Renderer *renderer = pass->source->renderer;
    const TileLaunch launch = {renderer->device->queue, kernel, {output, NULL}};
    return renderer_launch_tile(renderer, &launch, frame, error);
}

// Runs the kernel once over a tile without pixels, because drivers finish compiling in the first
// run.
static bool make_kernel(const AovPass *pass, cl_kernel *kernel, const char *name, cl_mem output,
                        Error *error)
{
    cl_int status;
    const Renderer *renderer = pass->source->renderer;
    *kernel = clCreateKernel(pass->program.handle, name, &status);
    return cl_succeeded(status, "create a kernel for channels", error) &&
           run_kernel(pass, *kernel, &renderer->frame, output, error) &&
           cl_succeeded(clFinish(renderer->device->queue), "finish the first run", error);
}

static bool build(AovPass *pass, Error *error)
{
    char key[PROGRAM_KEY_SIZE];
    CacheCheck build;
    const RendererSetup *setup = pass->source->setup;
    const SceneTraits traits = traits_general(pass->counts_tests);
    ProgramSource source = setup->source;
    source.entry = KERNEL_TILE;
    source.appended = aov_source;
    program_key(setup->device, &source, &traits, key);
    cache_check_begin(&build, setup->cache, key);
    const bool ok = program_build(&pass->program, setup->device, &source, &traits, error) &&
                    make_kernel(pass, &pass->trace_paths, "trace_paths", pass->paths, error) &&
                    (!pass->counts_tests ||
                     make_kernel(pass, &pass->count_tests, "count_tests", pass->tests, error));
    cache_check_end(&build, ok);
    return ok;
}

static bool make_room(AovPass *pass, Error *error)
{
    const Tile largest = tile_largest(&pass->source->renderer->settings);
    const size_t count = (size_t)largest.width * largest.height;
    const size_t tests = pass->counts_tests ? count : 1;
    const Device *device = pass->source->setup->device;
    pass->host_paths = memory_raw(count, sizeof *pass->host_paths, error);
    pass->host_tests = memory_raw(tests, sizeof *pass->host_tests, error);
    return pass->host_paths != NULL && pass->host_tests != NULL &&
           device_buffer(device, count * sizeof *pass->host_paths, &pass->paths, error) &&
           device_buffer(device, tests * sizeof *pass->host_tests, &pass->tests, error);
}

bool aov_pass_open(AovPass *pass, AovSet set, const AovSource *source, Error *error)
{
    *pass =
        (AovPass){.source = source, .set = set, .counts_tests = aov_needs(set, AOV_NEEDS_TESTS)};
    const bool ok = make_room(pass, error) && build(pass, error);
    if (!ok)
        aov_pass_close(pass);
    return ok;
}

void aov_pass_close(AovPass *pass)
{
    device_release_kernel(&pass->trace_paths);
    device_release_kernel(&pass->count_tests);
    device_release(&pass->paths);
    device_release(&pass->tests);
    program_free(&pass->program);
    free(pass->host_paths);
    free(pass->host_tests);
    *pass = (AovPass){0};
}

static FrameData frame_of(const Renderer *renderer, const Tile *tile, const CameraData *camera,
                          uint32_t samples)
{
    FrameData frame = renderer->frame;
    frame.camera = *camera;
    frame.samples = samples;
    tile_aim(&frame, &renderer->settings, tile);
    return frame;
}

static bool trace_tile(const AovPass *pass, const Tile *tile, Error *error)
{
    const AovSource *source = pass->source;
    const Renderer *renderer = source->renderer;
    const Device *device = renderer->device;
    const size_t count = (size_t)tile->width * tile->height;
    const FrameData center = frame_of(renderer, tile, &source->center, 1);
    const FrameData frame = frame_of(renderer, tile, &source->camera, renderer->frame.samples);
    if (!run_kernel(pass, pass->trace_paths, &center, pass->paths, error) ||
        !device_read(device, pass->paths, pass->host_paths, count * sizeof *pass->host_paths,
                     error))
        return false;
    return !pass->counts_tests ||
           (run_kernel(pass, pass->count_tests, &frame, pass->tests, error) &&
            device_read(device, pass->tests, pass->host_tests, count * sizeof *pass->host_tests,
                        error));
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

static void take_tile(const AovPass *pass, const Tile *tile, Layers *layers)
{
    for (uint32_t row = 0; row < tile->height; row++)
        for (uint32_t column = 0; column < tile->width; column++) {
            const size_t place = (size_t)row * tile->width + column;
            const uint32_t x = tile->left + column, y = tile->top + row;
            const AovPixel pixel = {&pass->host_paths[place],
                                    pass->counts_tests ? pass->host_tests[place] : NULL,
                                    samples_of(pass, x, y), certainty_at(pass, x, y)};
            aov_take(pass->set, layers_at(layers, x, y), &pixel, &pass->source->scene);
        }
}

bool aov_pass_draw(const AovPass *pass, const RenderObserver *observer, Layers *layers,
                   Error *error)
{
    const RenderSettings *settings = &pass->source->renderer->settings;
    RenderProgress progress = {.tiles = tile_count(settings)};
    bool wanted = true;
    while (wanted && progress.tiles_done < progress.tiles) {
        const Tile tile = tile_at(settings, progress.tiles_done);
        if (!trace_tile(pass, &tile, error))
            return false;
        take_tile(pass, &tile, layers);
        progress.tiles_done++;
        wanted = render_observer_continues(observer, &progress);
    }
    return true;
}
