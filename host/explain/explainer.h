// SPDX-License-Identifier: MIT
// A sample of a picture -> the rays it took, with what each met and which lights reached that, in
// the scene's own coordinates: traced once more, by a kernel of its own made of the picture's
// functions.
#pragma once

#include "render/renderer.h"
#include "scene/normalize.h"

typedef struct {
    LightState state;
    double cosine;           // between the normal and the way to the light
    double distance;         // of the light
    uint32_t blocker;        // id of a primitive between, NOTHING for none
    double blocker_distance; // from the point
    double diffuse;          // received: intensity * cosine
    double specular;         // received: intensity * highlight
} ExplainedLight;

typedef struct {
    Vec3 origin, direction; // of length 1
    double weight;          // of what the ray sees, in the sample's color
    uint32_t primitive;     // id, NOTHING where it meets none; the rest is then not set
    double distance, error; // distance is off by at most error
    Vec3 point, normal;
    uint32_t material;
    bool asks_lights;             // silhouettes do not
    double share;                 // of shaded in the sample's color
    Vec3 shaded;                  // the surface's own color
    const ExplainedLight *lights; // of the scene
} ExplainedRay;

// The ray that none follows, though the last surface reflects, has reached max_level: it sees the
// background.
typedef struct {
    uint32_t ray_count;
    const ExplainedRay *rays; // the camera's, then those reflected
    double background_weight; // of the background in the color, 0 where no ray came there
    double steps[3];          // the color in steps of 2^-32
} ExplainedSample;

typedef struct {
    const Renderer *renderer;
    const Scene *scene;
    const Normalization *normalization;
    FrameData frame;
    bool is_fp64;
    Program program;
    cl_kernel kernel;
    cl_mem values, words, result, count; // of a sample, on the device
    void *host_values;                   // floats, or doubles in fp64
    uint32_t *host_words;
    ExplainedRay *rays;     // max_level of them
    ExplainedLight *lights; // and as many times those of the scene
} Explainer;

// What an explainer stands on, and must outlive it.
typedef struct {
    const RendererSetup *setup;
    const Renderer *renderer;
    const Scene *scene;
    const Normalization *normalization;
    CameraData camera;
} ExplainerSource;

bool explainer_open(Explainer *explainer, const ExplainerSource *source, Error *error);
void explainer_close(Explainer *explainer);

// Traces the sample at column and row, counted in samples; it is valid until the next.
bool explainer_trace(Explainer *explainer, uint32_t column, uint32_t row, ExplainedSample *sample,
                     Error *error);

// The color that the picture's pixel has if its samples came to these sums of steps.
void explainer_mix(const Explainer *explainer, const uint64_t sums[3], float color[3]);
