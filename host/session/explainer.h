// SPDX-License-Identifier: MIT
// A sample of a picture -> the sample's rays in scene coordinates, with their hits and the state of
// each light. The kernel explain.cl traces the sample again with the functions that drew the
// picture (trace.cl).
#pragma once

#include "session/session.h"

typedef struct {
    ClrtExplainedRay found;           // found.size is unset
    Vec3 diffuse;                     // the diffuse color at the hit point
    const ClrtExplainedLight *lights; // found.light_count of them
} ExplainedRay;

// Rays of level max_level are listed only in scenes with glass. In other scenes, if the last ray
// hits a reflective surface, the surface reflects the background.
typedef struct {
    ClrtExplainedSample found;  // found.size is unset
    ExplainedRay *rays;         // found.ray_count, in the order of clrt.h; owned
    ClrtExplainedLight *lights; // of all rays; owned
} ExplainedSample;

void explained_sample_free(ExplainedSample *sample);

typedef struct {
    Renderer renderer; // with the picture's settings
    const Scene *scene;
    const Normalization *normalization;
    FrameData frame;
    bool is_fp64;
    uint32_t room;        // number of rays for which the buffers have room
    cl_mem values, words; // device buffers for one sample
    void *host_values;    // doubles if is_fp64, otherwise floats
    uint32_t *host_words;
    uint64_t sums[3]; // of the colors of the pixel's samples so far, in units of 2^-32
} Explainer;

// Prepares to explain the pixels of a picture of the session's scene. The session must keep the
// scene until the explainer is closed.
bool explainer_open(Explainer *explainer, Session *session, const RenderSettings *settings,
                    const Viewpoint *viewpoint, Error *error);
void explainer_close(Explainer *explainer);

// Traces a sample of a pixel and fills *sample, which the caller frees. Callers must trace all
// samples of a pixel in order, from index 0 on.
bool explainer_trace(Explainer *explainer, const uint32_t pixel[2], uint32_t index,
                     ExplainedSample *sample, Error *error);

// Stores the pixel's color. explainer_trace must have traced all samples of the pixel.
void explainer_mix(const Explainer *explainer, float color[3]);
