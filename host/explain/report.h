// SPDX-License-Identifier: MIT
// A pixel -> the explanation of its color as text or JSON.
#pragma once

#include "image/image_file.h"
#include "session/explainer.h"

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

// Traces the pixel's samples with explainer and writes them as text. Returns false if the device
// fails.
bool explain_write_text(const ExplainReport *report, Explainer *explainer, FILE *stream,
                        Error *error);

// Like explain_write_text, but returns JSON, or NULL if the device fails.
json_t *explain_json(const ExplainReport *report, Explainer *explainer, Error *error);
