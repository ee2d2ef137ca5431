// SPDX-License-Identifier: MIT
// The explained samples of a pixel -> a report as text or JSON.
#pragma once

#include "explain/explainer.h"
#include "image/image_file.h"

#include <jansson.h>
#include <stdio.h>

typedef struct {
    const char *scene_path;
    const Scene *scene;
    const RenderSettings *settings;
    uint32_t view; // number of the viewpoint, from 1
    uint32_t pixel[2];
    Encoding encoding;
    bool is_brief; // only the first sample and its important rays, with fewer facts and digits
} ExplainReport;

// The destination of explained samples: a list of JSON objects, or a text if list is NULL.
typedef struct {
    json_t *list;
    FILE *stream;
} ExplainOutput;

// Traces the pixel's samples one after another, writes them to output and stores the pixel's color.
bool explain_trace(const ExplainReport *report, Explainer *explainer, const ExplainOutput *output,
                   float color[3], Error *error);

// Writes the lines above the samples.
void explain_write_head(const ExplainReport *report, FILE *stream);

// Writes a sample. number is the sample's index in the pixel, from 0.
void explain_write_sample(const ExplainReport *report, const ExplainedSample *sample,
                          uint32_t number, FILE *stream);

void explain_write_color(const ExplainReport *report, const float color[3], FILE *stream);

json_t *explain_sample_json(const ExplainReport *report, const ExplainedSample *sample);

// Returns the whole report, and takes ownership of the JSON array samples.
json_t *explain_json(const ExplainReport *report, json_t *samples, const float color[3]);
