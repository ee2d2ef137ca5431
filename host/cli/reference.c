// SPDX-License-Identifier: MIT
// Each pass draws one sample per pixel, with the same sub-pixel shift for all pixels. The kernels
// need no change, because the camera is shifted. Even and odd passes make two pictures, whose
// difference measures the reference's own error. The shifts follow Roberts's R2 sequence, an
// additive recurrence by powers of the plastic number. Even and odd passes start at different
// shifts, so their errors are independent. No shift lies on the N x N grid of --aa.
//
// The reference is the picture in fp64, but most passes are in fp32, which is 6 to 9 times faster.
// Some passes are drawn in both precisions. Their mean difference is added to the mean of all fp32
// passes. The sum's expected value is the picture in fp64 (Giles, Multilevel Monte Carlo Path
// Simulation, 2008). The difference is nearly always zero, so few passes suffice to estimate it.
#include "cli/picture.h"

#include "base/clock.h"
#include "cli/process.h"
#include "image/image_file.h"
#include "scene/camera.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define ACROSS 0.7548776662466927
#define DOWN   0.5698402909980532

// About one of this many passes, and at least two passes, are drawn in fp64 too.
#define EXACT_STEP 16

typedef struct {
    ReferenceRenderers *renderers;
    Framebuffer pass;       // the latest one
    double (*halves[2])[3]; // the pictures of the even and of the odd passes
    Progress progress;
    uint32_t passes, exact_passes; // even numbers, at least 2
    uint32_t passes_done;
    uint32_t draws_done; // fp32 passes plus fp64 passes
    bool stopped;
} Reference;

static const double starts[2][2] = {{0.1327, 0.6180}, {0.8241, 0.2936}};

static double part(double value)
{
    return value - floor(value);
}

// Returns the level that the reference's rays reach. If clrt chose the picture's level by an error
// bound, the reference uses as many levels as a PFM file can show.
static uint32_t level_of(const Run *run)
{
    const Options *options = run->options;
    uint32_t level = run->settings.max_level;
    if (options->max_level < 0 && (options->fits_level || options->error_goal > 0))
        level = truncation_level(&run->scene, image_format_half_step("pfm", options->encoding) /
                                                  exp2(options->exposure));
    return level > run->scene.max_level ? level : run->scene.max_level;
}

static bool open_renderer(Renderer *renderer, Run *run, Precision precision, Error *error)
{
    const KernelRequest request = {.precision = precision};
    const Device *device = &run->async_device.device;
    RendererSetup setup = run->async_device.setup;
    setup.source.entry = KERNEL_TILE;
    setup.source.choice = kernel_choose(&request, device);
    if (!kernel_check_device(&setup.source.choice, device, error))
        return false;
    const FlatScene *flat = run_compiled_scene(run, setup.source.choice.nodes, error);
    RenderSettings settings = run->settings;
    settings.samples = 1;
    settings.max_level = level_of(run);
    settings.ready_tiles = 0;
    settings.group_width = settings.group_height = kernel_group_side(&setup.source.choice);
    settings.statistics = false;
    return flat != NULL && renderer_open(renderer, &setup, flat, &settings, error);
}

// Opens the renderers at the first frame of a run.
static bool open_renderers(ReferenceRenderers *renderers, Run *run, Error *error)
{
    renderers->is_open =
        renderers->is_open || (open_renderer(&renderers->fast, run, PRECISION_FP32, error) &&
                               open_renderer(&renderers->exact, run, PRECISION_FP64, error));
    return renderers->is_open;
}

void reference_close(ReferenceRenderers *renderers)
{
    renderer_close(&renderers->fast);
    renderer_close(&renderers->exact);
    *renderers = (ReferenceRenderers){0};
}

// Prints the progress of all passes together.
static bool tile_done(void *context, const RenderProgress *progress)
{
    Reference *reference = context;
    const uint32_t draws = reference->passes + reference->exact_passes;
    const RenderProgress whole = {.tiles_done = reference->draws_done * progress->tiles +
                                                progress->tiles_done,
                                  .tiles = draws * progress->tiles};
    reference->stopped = !progress_tile_done(&reference->progress, &whole);
    return !reference->stopped;
}

// Draws a pass and adds it, multiplied by weight, to the picture of its half. camera is the
// picture's, without a shift.
static bool add_pass(Reference *reference, Renderer *renderer, CameraData camera, double weight,
                     Error *error)
{
    const uint32_t half = reference->passes_done % 2;
    const double place = reference->passes_done / 2; // the index of the pass in its half
    camera_shift(&camera, part(starts[half][0] + place * ACROSS) - 0.5,
                 part(starts[half][1] + place * DOWN) - 0.5);
    const RenderObserver observer = {tile_done, reference};
    if (!renderer_draw(renderer, &camera, &observer, &reference->pass, error))
        return false;
    reference->draws_done++;
    const size_t pixels = (size_t)reference->pass.width * reference->pass.height;
    for (size_t pixel = 0; pixel < pixels; pixel++)
        for (int color = 0; color < 3; color++)
            reference->halves[half][pixel][color] +=
                weight * (double)reference->pass.pixels[pixel][color];
    return true;
}

static bool draw_pass(Reference *reference, CameraData camera, Error *error)
{
    ReferenceRenderers *renderers = reference->renderers;
    const bool is_exact = reference->passes_done < reference->exact_passes;
    const double exact = is_exact ? 2.0 / reference->exact_passes : 0;
    const double fast = 2.0 / reference->passes - exact;
    return add_pass(reference, &renderers->fast, camera, fast, error) &&
           (!is_exact || add_pass(reference, &renderers->exact, camera, exact, error));
}

static bool draw_passes(Reference *reference, Picture *picture, Error *error)
{
    const Run *run = picture->run;
    const CameraData camera =
        camera_make(&picture->viewpoint, &run->normalization, render_whole_width(&run->settings),
                    render_whole_height(&run->settings), 1);
    bool ok = true;
    reference->progress = progress_begin(run->options->quiet);
    while (ok && !reference->stopped && reference->passes_done < reference->passes) {
        ok = draw_pass(reference, camera, error);
        reference->passes_done++;
    }
    picture->stopped_by = progress_end(&reference->progress);
    return ok;
}

// Stores the mean of the two halves. Returns the RMSE of the mean, estimated from the halves'
// difference.
static double join_halves(const Reference *reference, Framebuffer *mean)
{
    const size_t pixels = (size_t)mean->width * mean->height;
    double squares = 0;
    for (size_t pixel = 0; pixel < pixels; pixel++)
        for (int color = 0; color < 3; color++) {
            const double one = reference->halves[0][pixel][color],
                         other = reference->halves[1][pixel][color];
            mean->pixels[pixel][color] = (float)((one + other) / 2);
            squares += (one - other) * (one - other) / 4;
        }
    return sqrt(squares / (3 * (double)pixels));
}

static StoredImage stored_view(const Framebuffer *framebuffer)
{
    return (StoredImage){.width = framebuffer->width,
                         .height = framebuffer->height,
                         .channel_count = 3,
                         .names = {"R", "G", "B"},
                         .values = framebuffer->pixels[0]};
}

static float error_of(const float drawn[3], const float truth[3])
{
    float largest = 0;
    for (int color = 0; color < 3; color++)
        largest = fmaxf(largest, fabsf(drawn[color] - truth[color]));
    return largest;
}

static void store_errors(Picture *picture)
{
    Layers *layers = &picture->layers;
    if (layers->count == 0 || strcmp(layers->list[layers->count - 1].name, ERROR_CHANNEL) != 0)
        return;
    const size_t pixels = (size_t)layers->width * layers->height;
    for (size_t pixel = 0; pixel < pixels; pixel++) {
        const float off =
            error_of(picture->framebuffer.pixels[pixel], picture->reference.pixels[pixel]);
        memcpy(&layers->values[(pixel + 1) * layers->count - 1], &off, sizeof off);
    }
}

static bool measure(Reference *reference, Picture *picture, Error *error)
{
    ReferenceResult *result = &picture->run->report.reference;
    const StoredImage drawn = stored_view(&picture->framebuffer);
    if (!framebuffer_make(&picture->reference, drawn.width, drawn.height, error))
        return false;
    result->own_error = join_halves(reference, &picture->reference);
    result->samples = reference->passes;
    const StoredImage truth = stored_view(&picture->reference);
    ImagePair pair = {{&truth, &drawn}, {"the reference", "the picture"}, {{0}}};
    if (!image_pair_check(&pair, error))
        return false;
    difference_measure(&result->difference, &pair);
    store_errors(picture);
    return true;
}

static bool draw_and_measure(Reference *reference, Picture *picture, Error *error)
{
    const RenderSettings *settings = &picture->run->settings;
    const size_t pixels = (size_t)settings->width * settings->height;
    for (int half = 0; half < 2; half++) {
        reference->halves[half] = memory_zeroed(pixels, sizeof *reference->halves[half], error);
        if (reference->halves[half] == NULL)
            return false;
    }
    return open_renderers(reference->renderers, picture->run, error) &&
           framebuffer_make(&reference->pass, settings->width, settings->height, error) &&
           draw_passes(reference, picture, error) &&
           (picture->stopped_by != 0 || measure(reference, picture, error));
}

void reference_name_layer(const Options *options, Layers *layers)
{
    const bool is_named = aov_needs(options->aovs, AOV_NEEDS_REFERENCE);
    if (options->reference && !is_named && image_format_takes_layers(options->format))
        layers->list[layers->count++] = (LayerType){.name = ERROR_CHANNEL};
}

bool reference_measure(Picture *picture, Error *error)
{
    Run *run = picture->run;
    if (picture->stopped_by != 0)
        return true;
    const double start = clock_seconds();
    Reference *reference = memory_zeroed(1, sizeof *reference, error);
    if (reference == NULL)
        return false;
    reference->renderers = &picture->reference_renderers;
    reference->passes = run->options->reference_samples;
    reference->exact_passes = 2 * (reference->passes / 2 / EXACT_STEP) + 2;
    if (reference->exact_passes > reference->passes)
        reference->exact_passes = reference->passes;
    const bool ok = draw_and_measure(reference, picture, error);
    run->report.reference.seconds = clock_seconds() - start;
    for (int half = 0; half < 2; half++)
        free(reference->halves[half]);
    framebuffer_free(&reference->pass);
    free(reference);
    return ok;
}

bool reference_write(const Picture *picture, const char *path, Error *error)
{
    const ImageSettings settings = {.format = image_format_of_path(path),
                                    .encoding = picture->run->options->encoding,
                                    .exposure = picture->run->options->exposure};
    return image_write(&picture->reference, path, &settings, error);
}
