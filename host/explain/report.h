// SPDX-License-Identifier: MIT
// A pixel -> the explanation of its color as text or JSON.
#pragma once

#include "explain/lights.h"

// Traces the pixel's samples with `explainer` and writes them as text. Returns false if the device
// fails.
bool explain_write_text(const ExplainReport *report, Explainer *explainer, FILE *stream,
                        Error *error);

// Like explain_write_text, but returns JSON, or NULL if the device fails.
json_t *explain_json(const ExplainReport *report, Explainer *explainer, Error *error);
