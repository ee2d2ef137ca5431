// SPDX-License-Identifier: MIT
// Uses an fp64 renderer whose program also contains the kernel certify_tile. Tiles do not overlap,
// because reading a pixel back is cheap compared with certifying it.
#include "render/certifier.h"

#include "render/tile.h"

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
    cl_kernel kernel = certifier->kernel;
    cl_int status = clSetKernelArg(kernel, 0, sizeof *frame, frame);
    for (cl_uint place = 0; place < RENDERER_ARRAYS && status == CL_SUCCESS; place++)
        status = clSetKernelArg(kernel, place + 1, sizeof(cl_mem), &renderer->arrays[place]);
    if (status == CL_SUCCESS)
        status = clSetKernelArg(kernel, RENDERER_ARRAYS + 1, sizeof(cl_mem), &certifier->colors);
    if (status == CL_SUCCESS)
        status = clSetKernelArg(kernel, RENDERER_ARRAYS + 2, sizeof(cl_mem), &certifier->marks);
    if (!cl_succeeded(status, "set the arguments of the kernel certify_tile", error))
        return false;
    const size_t group[2] = {renderer->settings.group_width, renderer->settings.group_height};
    size_t grid[2];
    tile_grid(&renderer->settings, renderer->nodes, grid);
    status = clEnqueueNDRangeKernel(renderer->device->queue, kernel, 2, NULL, grid, group, 0, NULL,
                                    NULL);
    return cl_succeeded(status, "run the kernel certify_tile", error);
}

static bool make_room(Certifier *certifier, Error *error)
{
    cl_int status;
    const Tile largest = tile_largest(&certifier->reference.settings);
    const size_t count = (size_t)largest.width * largest.height;
    const size_t colors = count * sizeof *certifier->host_colors;
    const size_t marks = count * sizeof *certifier->host_marks;
    cl_context context = certifier->reference.device->context;
    certifier->host_colors = memory_raw(count, sizeof *certifier->host_colors, error);
    certifier->host_marks = memory_raw(count, sizeof *certifier->host_marks, error);
    if (certifier->host_colors == NULL || certifier->host_marks == NULL)
        return false;
    certifier->colors = clCreateBuffer(context, CL_MEM_WRITE_ONLY, colors, NULL, &status);
    if (!cl_succeeded(status, "allocate a tile's repaired colors", error))
        return false;
    certifier->marks = clCreateBuffer(context, CL_MEM_WRITE_ONLY, marks, NULL, &status);
    return cl_succeeded(status, "allocate a tile's marks", error);
}

// Runs the kernel once over a tile without pixels, because drivers finish compiling in the first
// run.
static bool make_kernel(Certifier *certifier, const RendererSetup *setup, Error *error)
{
    cl_int status;
    char key[PROGRAM_KEY_SIZE];
    CacheBuild build;
    const SceneTraits traits = traits_general(false);
    const Renderer *reference = &certifier->reference;
    certifier->kernel = clCreateKernel(reference->program.handle, "certify_tile", &status);
    if (!cl_succeeded(status, "create the kernel certify_tile", error))
        return false;
    program_key(setup->device, &setup->source, &traits, key);
    cache_build_begin(&build, setup->cache, key);
    const bool ok = run_kernel(certifier, &reference->frame, error) &&
                    cl_succeeded(clFinish(reference->device->queue), "finish the first run", error);
    cache_build_end(&build, ok);
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
    if (certifier->kernel != NULL)
        clReleaseKernel(certifier->kernel);
    if (certifier->colors != NULL)
        clReleaseMemObject(certifier->colors);
    if (certifier->marks != NULL)
        clReleaseMemObject(certifier->marks);
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
    cl_command_queue queue = certifier->reference.device->queue;
    const size_t count = (size_t)frame->tile_width * frame->tile_height;
    if (!run_kernel(certifier, frame, error))
        return false;
    cl_int status = clEnqueueReadBuffer(queue, certifier->marks, CL_TRUE, 0,
                                        count * sizeof *certifier->host_marks,
                                        certifier->host_marks, 0, NULL, NULL);
    if (status == CL_SUCCESS)
        status = clEnqueueReadBuffer(queue, certifier->colors, CL_TRUE, 0,
                                     count * sizeof *certifier->host_colors, certifier->host_colors,
                                     0, NULL, NULL);
    return cl_succeeded(status, "read a tile's marks", error);
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
