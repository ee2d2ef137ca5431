// SPDX-License-Identifier: MIT
// Draws tiles by launches. Three launches are in flight, each in its own command queue. While the
// device traces one launch, another is read back or finishes its last work-groups. With two
// launches, a device that draws a tile of sky in 70 us would wait for the host.
//
// On CPUs, a launch is a tile. All launches use one padded grid with offset 0, because PoCL
// compiles a kernel again for each new local size, for nonzero offsets, and for large grids.
// Kernels read the tile's position from FrameData. On other devices, the size of a launch depends
// on the device and on the time of the previous launch (device/launch.h).
//
// Invariant: callers receive the tiles in the order of their numbers, so the number of finished
// tiles determines which tiles are finished.
#include "render/tile_pass.h"

#include "base/clock.h"
#include "device/buffer.h"

#include <string.h>

#define SLOTS 3

// A launch in flight.
typedef struct {
    cl_command_queue queue; // one per slot, so that launches overlap; NULL before the first launch
    cl_mem outputs[2];
    HostMemory values[2]; // copies of the outputs; not made for an output that is_read_in_place
    cl_event done;
    Tile area;
    uint64_t ended; // the number of tiles that end with this launch
    double start;
} Slot;

// A pass in progress.
typedef struct {
    const TilePass *pass;
    const Renderer *renderer;
    Slot slots[SLOTS];
    TileCursor cursor;
    uint64_t pixels;            // largest number of pixels of the next launch
    uint64_t started, finished; // launches
    double last_end;
} PassRun;

static bool is_paced(const Renderer *renderer)
{
    return renderer->kernel->launch.is_paced;
}

// Returns whether an output is copied straight into the framebuffer.
static bool is_read_in_place(const TilePass *pass, const Renderer *renderer, int output)
{
    return output == 0 && pass->framebuffer != NULL && !is_paced(renderer);
}

// Returns the largest number of pixels of a launch. On GPUs, this is at least one row of a tile.
static uint64_t most_pixels(const Renderer *renderer)
{
    const Tile largest = tile_largest(&renderer->settings);
    const uint64_t all = (uint64_t)renderer->settings.width * renderer->settings.height;
    const uint64_t items = renderer->kernel->launch.items;
    const uint64_t most = items > largest.width ? items : largest.width;
    if (!is_paced(renderer))
        return (uint64_t)largest.width * largest.height;
    return most < all ? most : all;
}

static bool open_slot(Slot *slot, const TilePass *pass, const Renderer *renderer, Error *error)
{
    const Device *device = renderer->kernel->device;
    // CPUs use no pool, because PoCL 6.0 has aborted with mapped buffers.
    HostPool *pool = device->is_cpu ? NULL : device->pool;
    const size_t count = most_pixels(renderer);
    cl_int status;
    slot->queue = clCreateCommandQueue(device->context, device->id, 0, &status);
    bool ok = cl_succeeded(status, "create an OpenCL queue", error);
    for (int i = 0; ok && i < 2; i++) {
        const size_t size = pass->sizes[i] > 0 ? count * pass->sizes[i] : 64;
        ok = (is_read_in_place(pass, renderer, i) ||
              host_memory_make(&slot->values[i], pool, size, error)) &&
             buffer_make(device, NULL, size, &slot->outputs[i], error);
    }
    return ok;
}

// Waits until the device has finished the slot's launch, and frees the slot.
static void close_slot(Slot *slot)
{
    if (slot->queue != NULL) {
        clFinish(slot->queue);
        clReleaseCommandQueue(slot->queue);
    }
    if (slot->done != NULL)
        clReleaseEvent(slot->done);
    for (int i = 0; i < 2; i++) {
        buffer_release(&slot->outputs[i]);
        host_memory_free(&slot->values[i]);
    }
    *slot = (Slot){0};
}

static bool launch(const Slot *slot, const Renderer *renderer, const FrameData *frame, Error *error)
{
    const Tile size = is_paced(renderer) ? slot->area : tile_largest(&renderer->settings);
    const size_t side = renderer->kernel->choice.nodes == NODES_WIDE ? BLOCK_SIDE : 1;
    const KernelRun run = {
        .queue = slot->queue,
        .frame = frame,
        .scene = renderer->scene->arrays,
        .arguments = {&slot->outputs[0], &slot->outputs[1]},
        .items = {(size.width + side - 1) / side, (size.height + side - 1) / side}};
    return kernel_run(renderer->kernel, &run, error);
}

// Starts the copy of an output to the slot's values, or to its place in the framebuffer.
static cl_int start_read(Slot *slot, const PassRun *run, int output, cl_event *done)
{
    const Tile *area = &slot->area;
    const Framebuffer *framebuffer = run->pass->framebuffer;
    const size_t size = run->pass->sizes[output], row = area->width * size;
    if (!is_read_in_place(run->pass, run->renderer, output))
        return clEnqueueReadBuffer(slot->queue, slot->outputs[output], CL_FALSE, 0,
                                   row * area->height, slot->values[output].data, 0, NULL, done);
    const size_t start[3] = {0}, place[3] = {area->left * size, area->top, 0};
    const size_t region[3] = {row, area->height, 1};
    return clEnqueueReadBufferRect(slot->queue, slot->outputs[output], CL_FALSE, start, place,
                                   region, row, 0, framebuffer->width * size, 0,
                                   framebuffer->pixels, 0, NULL, done);
}

// Starts the copies of the outputs. The first output is copied last, so slot->done signals that all
// copies have ended.
static bool start_reads(Slot *slot, const PassRun *run, Error *error)
{
    cl_int status = CL_SUCCESS;
    for (int i = 1; i >= 0 && status == CL_SUCCESS; i--)
        if (run->pass->sizes[i] > 0)
            status = start_read(slot, run, i, i == 0 ? &slot->done : NULL);
    if (status == CL_SUCCESS)
        status = clFlush(slot->queue);
    return cl_succeeded(status, "read a tile back", error);
}

// On GPUs, finish_launch starts the reads of the results. If they started here, some drivers would
// wait for the end of the launch, and the next launch would be late.
static bool start_launch(PassRun *run, Error *error)
{
    Slot *slot = &run->slots[run->started++ % SLOTS];
    const RenderSettings *settings = &run->renderer->settings;
    FrameData frame = run->pass->frame;
    slot->area = tile_next(settings, &run->cursor, run->pixels, &slot->ended);
    slot->start = clock_seconds();
    tile_aim(&frame, settings, &slot->area);
    if (slot->queue == NULL && !open_slot(slot, run->pass, run->renderer, error))
        return false;
    if (!launch(slot, run->renderer, &frame, error))
        return false;
    return is_paced(run->renderer) ? cl_succeeded(clFlush(slot->queue), "start the kernel", error)
                                   : start_reads(slot, run, error);
}

// Chooses the size of the next launches. A launch's time counts from its start or from the end of
// the previous launch, whichever is later.
static void pace(PassRun *run, const Slot *slot)
{
    const double now = clock_seconds();
    const double start = slot->start > run->last_end ? slot->start : run->last_end;
    const uint32_t pixels = slot->area.width * slot->area.height;
    run->pixels = launch_next_items(&run->renderer->kernel->launch, (uint32_t)run->pixels, pixels,
                                    now - start);
    run->last_end = now;
}

static void copy_colors(const Slot *slot, Framebuffer *framebuffer)
{
    const Tile *area = &slot->area;
    const float(*colors)[3] = slot->values[0].data;
    for (size_t row = 0; row < area->height; row++)
        memcpy(framebuffer->pixels[(area->top + row) * framebuffer->width + area->left],
               colors[row * area->width], area->width * sizeof *colors);
}

static bool finish_launch(PassRun *run, Error *error)
{
    Slot *slot = &run->slots[run->finished++ % SLOTS];
    const TilePass *pass = run->pass;
    const bool paced = is_paced(run->renderer);
    if ((paced && !start_reads(slot, run, error)) ||
        !cl_succeeded(clWaitForEvents(1, &slot->done), "trace a tile", error))
        return false;
    clReleaseEvent(slot->done);
    slot->done = NULL;
    if (paced)
        pace(run, slot);
    if (paced && pass->framebuffer != NULL)
        copy_colors(slot, pass->framebuffer);
    pass->take(pass->context, &slot->area,
               (void *const[2]){slot->values[0].data, slot->values[1].data});
    return true;
}

// Reports `count` tiles one by one. Returns whether to continue.
static bool report_tiles(uint64_t count, const RenderObserver *observer, RenderProgress *progress)
{
    bool wanted = true;
    for (; count > 0; count--) {
        progress->tiles_done++;
        wanted = render_observer_continues(observer, progress) && wanted;
    }
    return wanted;
}

// Runs the launches. After the observer stops the pass, the tiles in progress are still finished.
static bool run_launches(PassRun *run, const RenderObserver *observer, RenderProgress *progress,
                         Error *error)
{
    const uint64_t tiles = tile_count(&run->renderer->settings);
    bool wanted = true;
    while (true) {
        while (run->started < run->finished + SLOTS && run->cursor.number < tiles &&
               (wanted || run->cursor.row > 0))
            if (!start_launch(run, error))
                return false;
        if (run->finished == run->started)
            return true;
        const uint64_t ended = run->slots[run->finished % SLOTS].ended;
        if (!finish_launch(run, error))
            return false;
        wanted = report_tiles(ended, observer, progress) && wanted;
    }
}

bool tile_pass_run(const TilePass *pass, const Renderer *renderer, const RenderObserver *observer,
                   RenderProgress *progress, Error *error)
{
    const double samples = (double)pass->frame.samples * pass->frame.samples;
    const uint64_t first = launch_first_items(&renderer->kernel->launch, samples);
    PassRun run = {.pass = pass,
                   .renderer = renderer,
                   .cursor = {pass->first, 0},
                   .pixels = is_paced(renderer) ? first : most_pixels(renderer)};
    const bool ok = run_launches(&run, observer, progress, error);
    for (int slot = 0; slot < SLOTS; slot++)
        close_slot(&run.slots[slot]);
    return ok;
}

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

bool tile_pass_draw(Renderer *renderer, const CameraData *camera, const RenderObserver *observer,
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
