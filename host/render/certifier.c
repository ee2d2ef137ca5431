// SPDX-License-Identifier: MIT
// Uses an fp64 renderer whose program also contains the kernel certify_tile. Tiles do not overlap,
// because reading a pixel back is cheap compared with certifying it.
#include "render/certifier.h"

#include "device/buffer.h"
#include "render/renderer.h"

#include <stdlib.h>
#include <string.h>

// kernels/certify.cl, embedded at build time.
extern const char certify_source[];

KernelChoice certifier_choice(void)
{
    return (KernelChoice){FAMILY_RAY, NODES_PAIR, 0, PRECISION_FP64};
}

static bool check_device(const Device *device, Error *error)
{
    if (!device->has_fp64)
        return error_set(error, "%s has no double arithmetic, which --aov certainty needs",
                         device->name);
    return device->correct_division ||
           error_set(error, "%s does not round divisions correctly, which --aov certainty needs",
                     device->name);
}

static bool run_kernel(const Certifier *certifier, const FrameData *frame, Error *error)
{
    const Renderer *renderer = &certifier->reference;
    const TileLaunch launch = {
        renderer->device->queue, certifier->kernel, {certifier->colors, certifier->marks}};
    return renderer_launch_tile(renderer, &launch, frame, error);
}

static bool make_room(Certifier *certifier, Error *error)
{
    const Tile largest = tile_largest(&certifier->reference.settings);
    const size_t count = (size_t)largest.width * largest.height;
    const Device *device = certifier->reference.device;
    certifier->host_colors = memory_raw(count, sizeof *certifier->host_colors, error);
    certifier->host_marks = memory_raw(count, sizeof *certifier->host_marks, error);
    return certifier->host_colors != NULL && certifier->host_marks != NULL &&
           device_buffer(device, count * sizeof *certifier->host_colors, &certifier->colors,
                         error) &&
           device_buffer(device, count * sizeof *certifier->host_marks, &certifier->marks, error);
}

// Runs the kernel once over a tile without pixels, because drivers finish compiling in the first
// run.
static bool make_kernel(Certifier *certifier, const RendererSetup *setup, Error *error)
{
    cl_int status;
    char key[PROGRAM_KEY_SIZE];
    CacheCheck build;
    const SceneTraits traits = traits_general(false);
    const Renderer *reference = &certifier->reference;
    certifier->kernel = clCreateKernel(reference->program.handle, "certify_tile", &status);
    if (!cl_succeeded(status, "create the kernel certify_tile", error))
        return false;
    program_key(setup->device, &setup->source, &traits, key);
    cache_check_begin(&build, setup->cache, key);
    const bool ok = run_kernel(certifier, &reference->frame, error) &&
                    cl_succeeded(clFinish(reference->device->queue), "finish the first run", error);
    cache_check_end(&build, ok);
    return ok;
}

bool certifier_open(Certifier *certifier, const RendererSetup *setup, const FlatScene *flat,
                    const RenderSettings *settings, Error *error)
{
    RendererSetup reference = *setup;
    RenderSettings general = *settings;
    const uint32_t group = kernel_group_side(&setup->source.choice);
    *certifier = (Certifier){0};
    reference.source.appended = certify_source;
    reference.ready = NULL;
    general.specialization = SPECIALIZE_NEVER;
    general.statistics = false;
    general.group_width = general.group_height = group;
    const bool ok = check_device(setup->device, error) &&
                    renderer_open(&certifier->reference, &reference, flat, &general, error) &&
                    make_room(certifier, error) && make_kernel(certifier, &reference, error);
    if (!ok)
        certifier_close(certifier);
    return ok;
}

void certifier_close(Certifier *certifier)
{
    device_release_kernel(&certifier->kernel);
    device_release(&certifier->colors);
    device_release(&certifier->marks);
    free(certifier->host_colors);
    free(certifier->host_marks);
    renderer_close(&certifier->reference);
    *certifier = (Certifier){0};
}

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

static bool certify_tile(const Certifier *certifier, const FrameData *frame, Error *error)
{
    const Device *device = certifier->reference.device;
    const size_t count = (size_t)frame->tile_width * frame->tile_height;
    return run_kernel(certifier, frame, error) &&
           device_read(device, certifier->marks, certifier->host_marks,
                       count * sizeof *certifier->host_marks, error) &&
           device_read(device, certifier->colors, certifier->host_colors,
                       count * sizeof *certifier->host_colors, error);
}

static void take_tile(const Certifier *certifier, const Tile *tile, const CertifiedPicture *picture)
{
    CertaintyMap *map = picture->map;
    float(*pixels)[3] = picture->framebuffer->pixels;
    for (uint32_t row = 0; row < tile->height; row++)
        for (uint32_t column = 0; column < tile->width; column++) {
            const size_t place = (size_t)row * tile->width + column;
            const size_t pixel = (size_t)(tile->top + row) * map->width + tile->left + column;
            const CertaintyMark *mark = &certifier->host_marks[place];
            map->marks[pixel] = *mark;
            map->counts[mark->certainty]++;
            if (mark->certainty == CERTAINTY_REPAIRED)
                memcpy(pixels[pixel], certifier->host_colors[place], sizeof *pixels);
        }
}

bool certifier_certify(const Certifier *certifier, const CameraData *camera,
                       const RenderObserver *observer, const CertifiedPicture *picture,
                       Error *error)
{
    const RenderSettings *settings = &certifier->reference.settings;
    RenderProgress progress = {.tiles = tile_count(settings)};
    FrameData frame = certifier->reference.frame;
    bool wanted = true;
    frame.camera = *camera;
    while (wanted && progress.tiles_done < progress.tiles) {
        const Tile tile = tile_at(settings, progress.tiles_done);
        tile_aim(&frame, settings, &tile);
        if (!certify_tile(certifier, &frame, error))
            return false;
        take_tile(certifier, &tile, picture);
        progress.tiles_done++;
        wanted = render_observer_continues(observer, &progress);
    }
    return true;
}
