// SPDX-License-Identifier: MIT
// A ray's lights as JSON -> lines of text.
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

// Prints values of `json` by the template `text`. Brief reports have at most three digits.
void explain_print(const ExplainReport *report, const json_t *json, const char *text, FILE *stream);

// Prints nothing in brief reports.
void explain_print_detail(const ExplainReport *report, const json_t *json, const char *text,
                          FILE *stream);

// Prints a sphere's number, or a triangle's number and file. Brief reports omit the file's folder.
void explain_print_primitive(const ExplainReport *report, const json_t *primitive, FILE *stream);

// Prints a line for each light. All points of an area light share one line, unless glass colors the
// light from a point.
void explain_print_lights(const ExplainReport *report, const ExplainedRay *ray,
                          const json_t *lights, FILE *stream);
