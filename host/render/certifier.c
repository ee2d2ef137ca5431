// SPDX-License-Identifier: MIT
// Uses an fp64 renderer whose program also contains the kernel certify_tile.
#include "render/certifier.h"

#include "device/buffer.h"

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

static TilePass pass_of(const Certifier *certifier)
{
    return (TilePass){.kernel = certifier->kernel,
                      .frame = certifier->reference.frame,
                      .outputs = 2,
                      .sizes = {sizeof(float[3]), sizeof(CertaintyMark)}};
}

static bool make_kernel(Certifier *certifier, const RendererSetup *setup, Error *error)
{
    cl_int status;
    const Renderer *reference = &certifier->reference;
    certifier->kernel = clCreateKernel(reference->program.handle, "certify_tile", &status);
    if (!cl_succeeded(status, "create the kernel certify_tile", error))
        return false;
    const TilePass pass = pass_of(certifier);
    const int lock = cache_lock(setup->cache);
    const bool ok = tile_pass_warm_up(&pass, reference, error);
    cache_unlock(lock);
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
                    make_kernel(certifier, &reference, error);
    if (!ok)
        certifier_close(certifier);
    return ok;
}

void certifier_close(Certifier *certifier)
{
    device_release_kernel(&certifier->kernel);
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

bool certifier_certify(const Certifier *certifier, const CameraData *camera,
                       const RenderObserver *observer, const CertifiedPicture *picture,
                       Error *error)
{
    CertifiedPicture target = *picture;
    RenderProgress progress = {.tiles = tile_count(&certifier->reference.settings)};
    TilePass pass = pass_of(certifier);
    pass.frame.camera = *camera;
    pass.take = take_tile;
    pass.context = &target;
    return tile_pass_run(&pass, &certifier->reference, observer, &progress, error);
}
