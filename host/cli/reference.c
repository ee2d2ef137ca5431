// SPDX-License-Identifier: MIT
// Each pass draws one sample per pixel, with the same sub-pixel shift for all pixels. The kernels
// need no change, because the camera is shifted. Even and odd passes make two pictures, whose
// difference measures the reference's own error. Their shifts follow Roberts's R2 sequence, an
// additive recurrence by powers of the plastic number. The two sequences have different starts, so
// their errors are independent. No shift lies on the N x N grid of --aa.
#include "cli/picture.h"

#include "base/clock.h"
#include "image/image_file.h"
#include "scene/camera.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define ACROSS 0.7548776662466927
#define DOWN   0.5698402909980532

// The run that draws the reference.
typedef struct {
    Options options;
    Run run;
    Framebuffer pass;       // the latest one
    double (*halves[2])[3]; // the sums of the even and of the odd passes
    Progress progress;
    uint32_t passes, passes_done;
    bool stopped;
} Reference;

static const double starts[2][2] = {{0.1327, 0.6180}, {0.8241, 0.2936}};

static double part(double value)
{
    return value - floor(value);
}

static Options options_of(const Options *picture)
{
    Options options = *picture;
    options.kernel = (KernelRequest){.precision = PRECISION_FP64};
    options.samples = 1;
    // If clrt chose the picture's levels by an error bound, the reference uses as many levels as a
    // PFM file can show.
    options.fits_level = picture->max_level < 0 && (picture->fits_level || picture->error_goal > 0);
    options.format = "pfm";
    options.group_width = options.group_height = 0;
    options.contrast = options.error_goal = options.time_goal = 0;
    options.aovs = 0;
    options.statistics = false;
    options.quiet = true;
    return options;
}

static bool open_run(Reference *reference, const Run *original, Error *error)
{
    Run *run = &reference->run;
    reference->options = options_of(original->options);
    run->options = &reference->options;
    run->cache = original->cache;
    run_begin(run);
    if (!run_load_scene(run, error))
        return false;
    if (run->settings.max_level < run->scene.max_level)
        run->settings.max_level = run->scene.max_level;
    return run_prepare(run, error) == EXIT_DONE &&
           framebuffer_make(&reference->pass, run->settings.width, run->settings.height, error);
}

// Prints one progress for all passes together.
static bool tile_done(void *context, const RenderProgress *progress)
{
    Reference *reference = context;
    const RenderProgress whole = {.tiles_done = reference->passes_done * progress->tiles +
                                                progress->tiles_done,
                                  .tiles = reference->passes * progress->tiles};
    reference->stopped = !progress_tile_done(&reference->progress, &whole);
    return !reference->stopped;
}

static bool draw_pass(Reference *reference, const Viewpoint *viewpoint, uint32_t pass, Error *error)
{
    Run *run = &reference->run;
    const int half = (int)(pass % 2);
    const double place = pass / 2; // the index of the pass in its half
    CameraData camera =
        camera_make(viewpoint, &run->normalization, render_whole_width(&run->settings),
                    render_whole_height(&run->settings), 1);
    camera_shift(&camera, part(starts[half][0] + place * ACROSS) - 0.5,
                 part(starts[half][1] + place * DOWN) - 0.5);
    const RenderObserver observer = {tile_done, reference};
    if (!renderer_draw(&run->renderer, &camera, &observer, &reference->pass, error))
        return false;
    const size_t pixels = (size_t)reference->pass.width * reference->pass.height;
    for (size_t pixel = 0; pixel < pixels; pixel++)
        for (int color = 0; color < 3; color++)
            reference->halves[half][pixel][color] += (double)reference->pass.pixels[pixel][color];
    return true;
}

static bool draw_passes(Reference *reference, Picture *picture, Error *error)
{
    bool ok = true;
    reference->progress = progress_begin(picture->run->options->quiet);
    for (uint32_t pass = 0; ok && !reference->stopped && pass < reference->passes; pass++) {
        ok = draw_pass(reference, &picture->viewpoint, pass, error);
        reference->passes_done++;
    }
    picture->stopped_by = progress_end(&reference->progress);
    return ok;
}

// Stores the mean of the two halves. Returns the RMSE of the mean, estimated from their difference.
static double join_halves(const Reference *reference, Framebuffer *mean)
{
    const size_t pixels = (size_t)mean->width * mean->height;
    const double passes = reference->passes;
    double squares = 0;
    for (size_t pixel = 0; pixel < pixels; pixel++)
        for (int color = 0; color < 3; color++) {
            const double one = reference->halves[0][pixel][color],
                         other = reference->halves[1][pixel][color];
            mean->pixels[pixel][color] = (float)((one + other) / passes);
            squares += (one - other) * (one - other) / (passes * passes);
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
    return open_run(reference, picture->run, error) && draw_passes(reference, picture, error) &&
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
    reference->passes = run->options->reference_samples;
    const bool ok = draw_and_measure(reference, picture, error);
    run->report.reference.seconds = clock_seconds() - start;
    for (int half = 0; half < 2; half++)
        free(reference->halves[half]);
    framebuffer_free(&reference->pass);
    run_free(&reference->run);
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
