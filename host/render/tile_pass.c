// SPDX-License-Identifier: MIT
// Draws a picture tile by tile. Three tiles are in flight, each in its own command queue: the
// device traces one while another is read back or finishes its last work-groups. With two, a device
// that draws a tile of sky in 70 us waits for the host.
//
// All tiles use one padded grid with offset 0, because PoCL compiles another version of a kernel
// for each local size, for offsets and for large grids. The kernels receive a tile's position by
// FrameData instead of by the offset.
//
// Invariant: callers receive the tiles in the order of their numbers, so a count of finished tiles
// identifies them.
#include "render/tile_pass.h"

#include "device/buffer.h"

#include <stdlib.h>

#define SLOTS 3

// A tile in flight.
typedef struct {
    cl_command_queue queue; // one per slot, so that tiles overlap
    cl_mem outputs[2];
    void *values[2]; // host copies of the outputs; NULL for an output that is read in place
    cl_event done;
    Tile tile;
} Slot;

static bool is_read_in_place(const TilePass *pass, int output)
{
    return output == 0 && pass->framebuffer != NULL;
}

static bool open_slot(Slot *slot, const TilePass *pass, const Renderer *renderer, Error *error)
{
    const Device *device = renderer->kernel->device;
    const Tile largest = tile_largest(&renderer->settings);
    const size_t count = (size_t)largest.width * largest.height;
    cl_int status;
    slot->queue = clCreateCommandQueue(device->context, device->id, 0, &status);
    bool ok = cl_succeeded(status, "create an OpenCL queue", error);
    for (int i = 0; ok && i < pass->outputs; i++) {
        const size_t size = pass->sizes[i] > 0 ? count * pass->sizes[i] : 64;
        const bool in_place = is_read_in_place(pass, i);
        slot->values[i] = in_place ? NULL : memory_raw(size, 1, error);
        ok = (in_place || slot->values[i] != NULL) &&
             device_buffer(device, size, &slot->outputs[i], error);
    }
    return ok;
}

// Waits until the device has finished the slot's tile, and frees the slot.
static void close_slot(Slot *slot)
{
    if (slot->queue != NULL) {
        clFinish(slot->queue);
        clReleaseCommandQueue(slot->queue);
    }
    if (slot->done != NULL)
        clReleaseEvent(slot->done);
    for (int i = 0; i < 2; i++) {
        device_release(&slot->outputs[i]);
        free(slot->values[i]);
    }
    *slot = (Slot){0};
}

static size_t grid_side(const Kernel *kernel, uint32_t tile_side, uint32_t group)
{
    const uint32_t pixels = kernel->choice.nodes == NODES_WIDE ? BLOCK_SIDE : 1;
    const size_t items = ((size_t)tile_side + pixels - 1) / pixels;
    return (items + group - 1) / group * group;
}

static bool launch(const Slot *slot, const TilePass *pass, const Renderer *renderer,
                   const FrameData *frame, Error *error)
{
    const Kernel *kernel = renderer->kernel;
    const Tile largest = tile_largest(&renderer->settings);
    const size_t group[2] = {kernel->group[0], kernel->group[1]};
    const size_t grid[2] = {grid_side(kernel, largest.width, kernel->group[0]),
                            grid_side(kernel, largest.height, kernel->group[1])};
    cl_int status = CL_SUCCESS;
    if (!renderer_set_scene(renderer, frame, error))
        return false;
    for (int i = 0; i < pass->outputs && status == CL_SUCCESS; i++)
        status = clSetKernelArg(kernel->handle, FLAT_ARRAYS + 1 + (cl_uint)i, sizeof(cl_mem),
                                &slot->outputs[i]);
    if (status == CL_SUCCESS)
        status = clEnqueueNDRangeKernel(slot->queue, kernel->handle, 2, NULL, grid, group, 0, NULL,
                                        NULL);
    return cl_succeeded(status, "run the kernel", error);
}

// Starts the copy of an output to the slot's values, or to the tile's place in the framebuffer.
static cl_int start_read(Slot *slot, const TilePass *pass, int output, cl_event *done)
{
    const Tile *tile = &slot->tile;
    const size_t size = pass->sizes[output], row = tile->width * size;
    if (!is_read_in_place(pass, output))
        return clEnqueueReadBuffer(slot->queue, slot->outputs[output], CL_FALSE, 0,
                                   row * tile->height, slot->values[output], 0, NULL, done);
    const size_t start[3] = {0}, place[3] = {tile->left * size, tile->top, 0};
    const size_t region[3] = {row, tile->height, 1};
    return clEnqueueReadBufferRect(slot->queue, slot->outputs[output], CL_FALSE, start, place,
                                   region, row, 0, pass->framebuffer->width * size, 0,
                                   pass->framebuffer->pixels, 0, NULL, done);
}

// Starts the kernel for the slot's tile, and then the copies of its outputs. The first output is
// copied last, so slot->done signals the end of this copy.
static bool start_tile(Slot *slot, const TilePass *pass, const Renderer *renderer, Error *error)
{
    FrameData frame = pass->frame;
    tile_aim(&frame, &renderer->settings, &slot->tile);
    if (!launch(slot, pass, renderer, &frame, error))
        return false;
    cl_int status = CL_SUCCESS;
    for (int i = pass->outputs - 1; i >= 0 && status == CL_SUCCESS; i--)
        if (pass->sizes[i] > 0)
            status = start_read(slot, pass, i, i == 0 ? &slot->done : NULL);
    if (status == CL_SUCCESS)
        status = clFlush(slot->queue);
    return cl_succeeded(status, "read a tile back", error);
}

static bool finish_tile(Slot *slot, const TilePass *pass, Error *error)
{
    if (!cl_succeeded(clWaitForEvents(1, &slot->done), "trace a tile", error))
        return false;
    clReleaseEvent(slot->done);
    slot->done = NULL;
    pass->take(pass->context, &slot->tile, slot->values);
    return true;
}

bool tile_pass_run(const TilePass *pass, const Renderer *renderer, const RenderObserver *observer,
                   RenderProgress *progress, Error *error)
{
    Slot slots[SLOTS] = {0};
    const uint64_t tiles = tile_count(&renderer->settings);
    uint64_t started = pass->first, finished = pass->first;
    bool ok = true, wanted = true;
    for (int slot = 0; slot < SLOTS; slot++)
        ok = ok && open_slot(&slots[slot], pass, renderer, error);
    while (ok && finished < (wanted ? tiles : started)) {
        for (; ok && wanted && started < tiles && started < finished + SLOTS; started++) {
            Slot *slot = &slots[started % SLOTS];
            slot->tile = tile_at(&renderer->settings, started);
            ok = start_tile(slot, pass, renderer, error);
        }
        ok = ok && finish_tile(&slots[finished++ % SLOTS], pass, error);
        progress->tiles_done += ok;
        wanted = ok && render_observer_continues(observer, progress) && wanted;
    }
    for (int slot = 0; slot < SLOTS; slot++)
        close_slot(&slots[slot]);
    return ok;
}

// Bytes that suffice for every kernel's output of one pixel.
#define LARGEST_OUTPUT 256

static bool run_once(Renderer *renderer, const TilePass *pass, Error *error)
{
    Slot slot = {0};
    const bool ok = open_slot(&slot, pass, renderer, error) &&
                    launch(&slot, pass, renderer, &pass->frame, error) &&
                    cl_succeeded(clFinish(slot.queue), "finish the first run", error);
    close_slot(&slot);
    return ok;
}

static bool run_one_output(Renderer *renderer, Error *error)
{
    return run_once(renderer, &(TilePass){.outputs = 1, .sizes = {LARGEST_OUTPUT}}, error);
}

static bool run_two_outputs(Renderer *renderer, Error *error)
{
    const TilePass pass = {.outputs = 2, .sizes = {LARGEST_OUTPUT, LARGEST_OUTPUT}};
    return run_once(renderer, &pass, error);
}

bool tile_pass_run_first(const Kernel *kernel, int outputs, Error *error)
{
    return renderer_run_first(kernel, outputs == 1 ? run_one_output : run_two_outputs, error);
}
