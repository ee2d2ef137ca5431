// SPDX-License-Identifier: MIT
// Certifies a finished picture, and measures its error against a reference.
#include "cli/picture.h"

#include "base/clock.h"
#include "cli/progress.h"
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
            error_of(picture->framebuffer.pixels[pixel], picture->reference.pixels[pixel]);
        memcpy(&layers->values[(pixel + 1) * layers->count - 1], &off, sizeof off);
    }
}

static bool measure(Picture *picture, const ReferencePicture *reference, Error *error)
{
    ReferenceResult *result = &picture->run->report.reference;
    const StoredImage drawn = stored_view(&picture->framebuffer);
    const StoredImage truth = stored_view(&picture->reference);
    ImagePair pair = {{&truth, &drawn}, {"the reference", "the picture"}, {{0}}};
    result->own_error = reference->own_error;
    result->samples = picture->run->request.reference_samples;
    if (!image_pair_check(&pair, error))
        return false;
    difference_measure(&result->difference, &pair);
    store_errors(picture);
    return true;
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
    double moment = clock_seconds();
    ReferencePicture reference;
    const SessionPicture request = picture_request(picture);
    if (picture->stopped_by != 0)
        return true;
    Progress progress = progress_begin(run->options->quiet);
    const RenderObserver observer = {progress_tile_done, &progress};
    bool ok = reference_draw(&run->session, &request, &observer, &reference, error);
    picture->stopped_by = progress_end(&progress);
    picture->reference = reference.picture;
    if (ok && reference.picture.pixels != NULL)
        ok = measure(picture, &reference, error);
    run->report.reference.seconds = run_lap(&moment);
    return ok;
}

bool reference_write(const Picture *picture, const char *path, Error *error)
{
    const ImageSettings settings = {.format = image_format_of_path(path),
                                    .encoding = picture->run->options->encoding,
                                    .exposure = picture->run->options->exposure};
    return image_write(&picture->reference, path, &settings, error);
}

bool certain_picture_make(Picture *picture, Error *error)
{
    Run *run = picture->run;
    double moment = clock_seconds();
    const Framebuffer *frame = &picture->framebuffer;
    const SessionPicture request = picture_request(picture);
    if (!certainty_map_make(&picture->certainty, frame->width, frame->height, error))
        return false;
    if (picture->stopped_by != 0)
        return true;
    const CertifiedPicture certified = {&picture->framebuffer, &picture->certainty};
    Progress progress = progress_begin(run->options->quiet);
    const RenderObserver observer = {progress_tile_done, &progress};
    const bool ok = session_certify(&run->session, &request, &observer, &certified, error);
    picture->stopped_by = progress_end(&progress);
    run->report.complete = run->report.complete && picture->stopped_by == 0;
    run->report.certainty.seconds = run_lap(&moment);
    memcpy(run->report.certainty.pixels, picture->certainty.counts,
           sizeof picture->certainty.counts);
    return ok;
}
