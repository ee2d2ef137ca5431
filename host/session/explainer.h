// SPDX-License-Identifier: MIT
// One sample of a picture -> its rays in scene coordinates, with their hits and the state of each
// light. A separate kernel traces the sample again with the functions that drew the picture
// (trace.cl).
#pragma once

#include "session/session.h"

typedef struct {
    ClrtExplainedRay found;           // found.size is unset
    Vec3 diffuse;                     // the diffuse color, of the material or of the vertices
    const ClrtExplainedLight *lights; // found.light_count of them
} ExplainedRay;

// If the last ray hits a reflective surface, the surface reflects the background, because the next
// ray would have the level max_level. In scenes with glass, rays of this level also have records.
typedef struct {
    ClrtExplainedSample found;  // found.size is unset
    ExplainedRay *rays;         // found.ray_count, in the order of clrt.h; owned
    ClrtExplainedLight *lights; // of all rays; owned
} ExplainedSample;

void explained_sample_free(ExplainedSample *sample);

typedef struct {
    Renderer renderer; // with the settings of the picture
    const Scene *scene;
    const Normalization *normalization;
    FrameData frame;
    bool is_fp64;
    uint32_t room;        // rays for which the buffers have room
    cl_mem values, words; // device buffers for one sample
    void *host_values;    // doubles if is_fp64, otherwise floats
    uint32_t *host_words;
    uint64_t sums[3]; // of the colors of the pixel's samples, in units of 2^-32
} Explainer;

// Prepares to explain the pixels of a picture of the session's scene. The session must keep the
// scene until the explainer is closed.
bool explainer_open(Explainer *explainer, Session *session, const RenderSettings *settings,
                    const Viewpoint *viewpoint, Error *error);
void explainer_close(Explainer *explainer);

// Traces a sample of a pixel into *sample, which the caller frees. Callers must trace all samples
// of a pixel in order, from index 0 on.
bool explainer_trace(Explainer *explainer, const uint32_t pixel[2], uint32_t index,
                     ExplainedSample *sample, Error *error);

// Stores the pixel's color. explainer_trace must have traced all samples of the pixel.
void explainer_mix(const Explainer *explainer, float color[3]);
