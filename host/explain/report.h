// SPDX-License-Identifier: MIT
// The explained samples of a pixel -> a report as text or JSON.
#pragma once

#include "cli/options/options.h"
#include "explain/explainer.h"

#include <jansson.h>
#include <stdio.h>

typedef struct {
    const Options *options;
    const Scene *scene;
    const RenderSettings *settings;
} ExplainReport;

// Writes the lines above the samples.
void explain_write_head(const ExplainReport *report, FILE *stream);

// Writes a sample. number is the sample's index in the pixel, from 0.
void explain_write_sample(const ExplainReport *report, const ExplainedSample *sample,
                          uint32_t number, FILE *stream);

void explain_write_color(const ExplainReport *report, const float color[3], FILE *stream);

json_t *explain_sample_json(const ExplainReport *report, const ExplainedSample *sample);

// Returns the whole report, and takes ownership of the JSON array samples.
json_t *explain_json(const ExplainReport *report, json_t *samples, const float color[3]);
