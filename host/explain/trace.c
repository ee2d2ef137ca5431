// SPDX-License-Identifier: MIT
// Only one sample is in memory, because each is written at once.
#include "explain/report.h"

bool explain_trace(const ExplainReport *report, Explainer *explainer, const ExplainOutput *output,
                   float color[3], Error *error)
{
    ExplainedSample sample;
    uint64_t sums[3] = {0};
    const uint32_t *pixel = report->pixel;
    const uint32_t side = report->settings->samples;
    for (uint32_t i = 0; i < side * side; i++) {
        if (!explainer_trace(explainer, pixel[0] * side + i % side, pixel[1] * side + i / side,
                             &sample, error))
            return false;
        for (int channel = 0; channel < 3; channel++)
            sums[channel] += (uint64_t)sample.steps[channel];
        if (output->list != NULL)
            json_array_append_new(output->list, explain_sample_json(report, &sample));
        else if (i == 0 || !report->is_brief)
            explain_write_sample(report, &sample, i, output->stream);
    }
    explainer_mix(explainer, sums, color);
    return true;
}
