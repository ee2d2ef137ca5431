// SPDX-License-Identifier: MIT
#include "cli/picture_error.h"

#include "base/clock.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "session/reference.h"

#include <math.h>
#include <string.h>

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
            error_of(picture->framebuffer.pixels[pixel], picture->reference.picture.pixels[pixel]);
        memcpy(&layers->values[(pixel + 1) * layers->count - 1], &off, sizeof off);
    }
}

static bool measure(Picture *picture, const ReferencePicture *reference, Error *error)
{
    MeasuredReference *measured = &picture->reference;
    const StoredImage drawn = stored_view(&picture->framebuffer);
    const StoredImage truth = stored_view(&measured->picture);
    ComparedImages compared = {{&truth, &drawn}, {"the reference", "the picture"}, {{0}}};
    measured->own_error = reference->own_error;
    measured->samples = picture->request.reference_samples;
    if (!compared_images_check(&compared, error))
        return false;
    difference_measure(&measured->difference, &compared);
    store_errors(picture);
    return true;
}

void picture_error_name_layer(const Options *options, Layers *layers)
{
    const bool is_named = aov_needs(options->aovs, AOV_NEEDS_REFERENCE);
    if (options->reference && !is_named && image_format_takes_layers(options->format))
        layers->list[layers->count++] = (LayerType){.name = ERROR_CHANNEL};
}

bool picture_error_measure(Picture *picture, Error *error)
{
    double moment = clock_seconds();
    ReferencePicture reference;
    if (!picture->options->reference || picture->stopped_by != 0)
        return true;
    Progress progress = progress_begin(picture->options->quiet);
    const RenderObserver observer = {progress_tile_done, &progress};
    bool ok = reference_draw(picture->session, &picture->request, &observer, &reference, error);
    picture->stopped_by = progress_end(&progress);
    picture->reference.picture = reference.picture;
    if (ok && reference.picture.pixels != NULL)
        ok = measure(picture, &reference, error);
    picture->reference.seconds = stage_lap(&moment);
    if (ok && !picture->options->quiet)
        report_write_error(&picture->reference, stderr);
    return ok;
}

bool picture_error_write_reference(const Picture *picture, Error *error)
{
    const char *path = picture->options->reference_path;
    if (path == NULL || picture->reference.picture.pixels == NULL)
        return true;
    const ImageSettings settings = {.format = image_format_of_path(path),
                                    .encoding = picture->options->encoding,
                                    .exposure = picture->options->exposure};
    return image_write(&picture->reference.picture, path, &settings, error);
}
