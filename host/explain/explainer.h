// SPDX-License-Identifier: MIT
// One sample of a picture -> its rays in scene coordinates, with hits and the state of each light.
// A separate kernel traces the sample again with the picture's functions.
#pragma once

#include "render/renderer.h"
#include "scene/normalize.h"

typedef struct {
    LightState state;
    double cosine;           // between the normal and the direction to the light
    double distance;         // to the light
    uint32_t blocker;        // id of the blocking primitive, or NOTHING
    double blocker_distance; // from the hit point; 0 unless state is LIGHT_BLOCKED
    double diffuse;          // intensity * cosine; 0 unless state is LIGHT_SEEN
    double specular;         // intensity * highlight; 0 unless state is LIGHT_SEEN
} ExplainedLight;

typedef struct {
    Vec3 origin, direction; // direction has length 1
    double weight;          // weight in the sample's color
    uint32_t primitive;     // id of the hit primitive; NOTHING for a miss: the next fields are zero
    double distance, error; // error bounds the error of distance
    Vec3 point, normal;
    uint32_t material;
    bool uses_lights;             // false for silhouettes
    double share;                 // weight of `shaded` in the sample's color
    Vec3 shaded;                  // surface color without reflections
    const ExplainedLight *lights; // one per light of the scene
} ExplainedRay;

// If the last ray hits a reflective surface, it has reached max_level, and its reflection shows the
// background.
typedef struct {
    uint32_t ray_count;
    const ExplainedRay *rays; // the camera ray, then the reflected rays
    double background_weight; // weight in the sample's color
    double steps[3];          // the sample's color in units of 2^-32
} ExplainedSample;

typedef struct {
    const Renderer *renderer;
    const Scene *scene;
    const Normalization *normalization;
    FrameData frame;
    bool is_fp64;
    Program program;
    cl_kernel kernel;
    cl_mem values, words, result, count; // device buffers for one sample
    void *host_values;                   // doubles if is_fp64, otherwise floats
    uint32_t *host_words;
    ExplainedRay *rays;     // one per level
    ExplainedLight *lights; // one per level and light of the scene
} Explainer;

// Inputs that must outlive the Explainer.
typedef struct {
    const RendererSetup *setup;
    const Renderer *renderer;
    const Scene *scene;
    const Normalization *normalization;
    CameraData camera;
} ExplainerSource;

bool explainer_open(Explainer *explainer, const ExplainerSource *source, Error *error);
void explainer_close(Explainer *explainer);

// Traces one sample into *sample, which stays valid until the next call. column and row count
// samples, not pixels.
bool explainer_trace(Explainer *explainer, uint32_t column, uint32_t row, ExplainedSample *sample,
                     Error *error);

// Stores the pixel's color. sums holds the sums of ExplainedSample::steps over its samples.
void explainer_mix(const Explainer *explainer, const uint64_t sums[3], float color[3]);
