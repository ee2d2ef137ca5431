// SPDX-License-Identifier: MIT
// Keeps two tiles in flight, each in its own queue. One tile is traced while the other is read back
// or finishes its last work-groups. All tiles use the same padded grid with offset 0, because PoCL
// compiles a kernel again for each new local size and kind of grid.
#include "render/renderer.h"

#include "device/buffer.h"

#include <stdlib.h>

#define SLOTS 2

// A tile in flight.
typedef struct {
    cl_command_queue queue; // one per slot, so that tiles overlap
    cl_mem pixels, tallies; // device buffers
    uint (*host_tallies)[TALLY_KINDS];
    cl_event done;
    Tile tile;
} Slot;

typedef struct {
    Renderer *renderer;
    Framebuffer *framebuffer;
    Slot slots[SLOTS];
} Drawing;

static bool open_slot(Slot *slot, const Renderer *renderer, Error *error)
{
    const RenderSettings *settings = &renderer->settings;
    const Tile largest = tile_largest(settings);
    const size_t count = (size_t)largest.width * largest.height;
    const size_t tallies = settings->statistics ? count : 1;
    const Device *device = renderer->device;
    cl_int status;
    slot->queue = clCreateCommandQueue(device->context, device->id, 0, &status);
    if (!cl_succeeded(status, "create an OpenCL queue", error))
        return false;
    slot->host_tallies = memory_raw(tallies, sizeof *slot->host_tallies, error);
    return slot->host_tallies != NULL &&
           device_buffer(device, count * 3 * sizeof(float), &slot->pixels, error) &&
           device_buffer(device, tallies * sizeof *slot->host_tallies, &slot->tallies, error);
}

// Waits until the device has finished writing, and frees the slot.
static void close_slot(Slot *slot)
{
    if (slot->queue != NULL) {
        clFinish(slot->queue);
        clReleaseCommandQueue(slot->queue);
    }
    if (slot->done != NULL)
        clReleaseEvent(slot->done);
    device_release(&slot->pixels);
    device_release(&slot->tallies);
    free(slot->host_tallies);
    *slot = (Slot){0};
}

bool renderer_set_scene(const Renderer *renderer, cl_kernel kernel, const FrameData *frame,
                        Error *error)
{
    cl_int status = clSetKernelArg(kernel, 0, sizeof *frame, frame);
    for (cl_uint place = 0; place < FLAT_ARRAYS && status == CL_SUCCESS; place++)
        status = clSetKernelArg(kernel, place + 1, sizeof(cl_mem), &renderer->arrays[place]);
    return cl_succeeded(status, "set the kernel's arguments", error);
}

bool renderer_launch_tile(const Renderer *renderer, const TileLaunch *launch,
                          const FrameData *frame, Error *error)
{
    const RenderSettings *settings = &renderer->settings;
    const size_t group[2] = {settings->group_width, settings->group_height};
    cl_int status = CL_SUCCESS;
    size_t grid[2];
    if (!renderer_set_scene(renderer, launch->kernel, frame, error))
        return false;
    for (cl_uint i = 0; i < 2 && launch->outputs[i] != NULL && status == CL_SUCCESS; i++)
        status = clSetKernelArg(launch->kernel, FLAT_ARRAYS + 1 + i, sizeof(cl_mem),
                                &launch->outputs[i]);
    tile_grid(settings, renderer->nodes, grid);
    if (status == CL_SUCCESS)
        status = clEnqueueNDRangeKernel(launch->queue, launch->kernel, 2, NULL, grid, group, 0,
                                        NULL, NULL);
    return cl_succeeded(status, "run the kernel", error);
}

static bool run_kernel(const Renderer *renderer, const Slot *slot, const FrameData *frame,
                       Error *error)
{
    const TileLaunch launch = {slot->queue, renderer->kernel, {slot->pixels, slot->tallies}};
    return renderer_launch_tile(renderer, &launch, frame, error);
}

bool draw_warm_up(Renderer *renderer, Error *error)
{
    Slot slot = {0};
    const bool ok = open_slot(&slot, renderer, error) &&
                    run_kernel(renderer, &slot, &renderer->frame, error) &&
                    cl_succeeded(clFinish(slot.queue), "finish the first run", error);
    close_slot(&slot);
    return ok;
}

// Starts to copy the slot's colors into the framebuffer; slot->done signals the end.
static cl_int read_pixels(const Drawing *drawing, Slot *slot)
{
    Framebuffer *framebuffer = drawing->framebuffer;
    const Tile *tile = &slot->tile;
    const size_t pixel = sizeof *framebuffer->pixels;
    const size_t from[3] = {0, 0, 0}, to[3] = {tile->left * pixel, tile->top, 0};
    const size_t region[3] = {tile->width * pixel, tile->height, 1};
    return clEnqueueReadBufferRect(slot->queue, slot->pixels, CL_FALSE, from, to, region,
                                   tile->width * pixel, 0, framebuffer->width * pixel, 0,
                                   framebuffer->pixels, 0, NULL, &slot->done);
}

static bool start_tile(const Drawing *drawing, Slot *slot, FrameData frame, Error *error)
{
    const Renderer *renderer = drawing->renderer;
    const size_t count = (size_t)slot->tile.width * slot->tile.height;
    tile_aim(&frame, &renderer->settings, &slot->tile);
    if (!run_kernel(renderer, slot, &frame, error))
        return false;
    cl_int status = CL_SUCCESS;
    if (renderer->settings.statistics)
        status = clEnqueueReadBuffer(slot->queue, slot->tallies, CL_FALSE, 0,
                                     count * sizeof *slot->host_tallies, slot->host_tallies, 0,
                                     NULL, NULL);
    if (status == CL_SUCCESS)
        status = read_pixels(drawing, slot);
    if (status == CL_SUCCESS)
        status = clFlush(slot->queue);
    return cl_succeeded(status, "read a tile back", error);
}

// Waits for a tile and adds its tallies to the progress.
static bool finish_tile(Drawing *drawing, Slot *slot, Error *error)
{
    Renderer *renderer = drawing->renderer;
    if (!cl_succeeded(clWaitForEvents(1, &slot->done), "trace a tile", error))
        return false;
    clReleaseEvent(slot->done);
    slot->done = NULL;
    renderer->progress.tiles_done++;
    const size_t count =
        renderer->settings.statistics ? (size_t)slot->tile.width * slot->tile.height : 0;
    for (size_t pixel = 0; pixel < count; pixel++)
        for (int kind = 0; kind < TALLY_KINDS; kind++)
            renderer->progress.tallies[kind] += slot->host_tallies[pixel][kind];
    return true;
}

static bool draw_tiles(Drawing *drawing, const FrameData *frame, const RenderObserver *observer,
                       Error *error)
{
    Renderer *renderer = drawing->renderer;
    const uint64_t tiles = tile_count(&renderer->settings);
    const uint64_t ready = renderer->settings.ready_tiles;
    renderer->progress =
        (RenderProgress){.tiles_done = ready, .tiles = tiles, .tiles_ready = ready};
    uint64_t started = ready;
    bool wanted = true;
    while (renderer->progress.tiles_done < (wanted ? tiles : started)) {
        while (wanted && started < tiles && started < renderer->progress.tiles_done + SLOTS) {
            Slot *slot = &drawing->slots[started % SLOTS];
            slot->tile = tile_at(&renderer->settings, started);
            if (!start_tile(drawing, slot, *frame, error))
                return false;
            started++;
        }
        Slot *oldest = &drawing->slots[renderer->progress.tiles_done % SLOTS];
        if (!finish_tile(drawing, oldest, error))
            return false;
        wanted = render_observer_continues(observer, &renderer->progress) && wanted;
    }
    return true;
}

bool renderer_draw(Renderer *renderer, const CameraData *camera, const RenderObserver *observer,
                   Framebuffer *framebuffer, Error *error)
{
    Drawing drawing = {.renderer = renderer, .framebuffer = framebuffer};
    FrameData frame = renderer->frame;
    frame.camera = *camera;
    bool ok = true;
    for (int slot = 0; slot < SLOTS; slot++)
        ok = ok && open_slot(&drawing.slots[slot], renderer, error);
    ok = ok && draw_tiles(&drawing, &frame, observer, error);
    for (int slot = 0; slot < SLOTS; slot++)
        close_slot(&drawing.slots[slot]);
    return ok;
}
