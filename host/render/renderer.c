// SPDX-License-Identifier: MIT
#include "render/renderer.h"

#include <math.h>

FrameData renderer_frame(const Renderer *renderer, const CameraData *camera)
{
    const RenderSettings *settings = &renderer->settings;
    FrameData frame = renderer->scene->frame;
    frame.camera = *camera;
    frame.width = render_whole_width(settings);
    frame.height = render_whole_height(settings);
    frame.samples = settings->samples;
    frame.max_level = settings->max_level;
    if (renderer->scene->traits.glass && frame.max_level > GLASS_LEVELS)
        frame.max_level = GLASS_LEVELS;
    return frame;
}

TallyKind renderer_first_tally(const Renderer *renderer)
{
    const SceneTraits *traits = &renderer->kernel->traits;
    return traits->statistics || traits->glass ? TALLY_FIRST(traits->statistics) : TALLY_KINDS;
}

void renderer_add_tallies(Renderer *renderer, const uint32_t *stored, size_t count)
{
    const TallyKind first = renderer_first_tally(renderer);
    for (size_t tally = 0; first < TALLY_KINDS && tally < count; tally++)
        for (uint32_t kind = first; kind < TALLY_KINDS; kind++)
            renderer->progress.tallies[kind] += *stored++;
}

double renderer_truncation(const Renderer *renderer, uint64_t samples)
{
    const uint64_t *tallies = renderer->progress.tallies;
    const double squares = (double)tallies[TALLY_CUT_HIGH] + (double)tallies[TALLY_CUT] * 0x1p-32;
    return sqrt(squares / (double)samples);
}
