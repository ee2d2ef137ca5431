// SPDX-License-Identifier: MIT
// One sample of a picture -> its rays in scene coordinates, with their hits and the state of each
// light.
// A separate kernel traces the sample again with the functions that drew the picture (trace.cl).
#pragma once

#include "session/session.h"

typedef struct {
    LightState state;
    double cosine;           // between the normal and the direction to the light
    double distance;         // to the light
    uint32_t blocker;        // id of the blocking primitive, or NOTHING
    double blocker_distance; // from the hit point; 0 unless state is LIGHT_BLOCKED
    double diffuse;          // intensity * cosine; 0 unless state is LIGHT_SEEN
    double specular;         // intensity * shine; 0 unless state is LIGHT_SEEN
    double shine;            // (normal . half vector)^shininess; 0 unless state is LIGHT_SEEN
} ExplainedLight;

typedef struct {
    Vec3 origin, direction; // direction has length 1
    double weight;          // weight in the sample's color
    uint32_t primitive;     // id of the hit primitive; NOTHING for a miss: all fields below are 0
    double distance, error; // error bounds the error of distance
    Vec3 point, normal;
    uint32_t material;
    bool uses_lights;             // false for silhouettes
    Vec3 diffuse;                 // the diffuse color, of the material or of the vertices
    double share;                 // weight of `shaded` in the sample's color
    Vec3 shaded;                  // surface color without reflections
    const ExplainedLight *lights; // one per light of the scene; unset unless uses_lights
} ExplainedRay;

// If the last ray hits a reflective surface, the surface reflects the background, because a next
// ray would have the level max_level.
typedef struct {
    uint32_t ray_count;
    const ExplainedRay *rays; // the camera ray, then the reflected rays
    double background_weight; // weight in the sample's color
    double steps[3];          // the sample's color in units of 2^-32
} ExplainedSample;

typedef struct {
    Renderer renderer; // with the settings of the picture
    const Scene *scene;
    const Normalization *normalization;
    FrameData frame;
    bool is_fp64;
    cl_mem values, words, result, count; // device buffers for one sample
    void *host_values;                   // doubles if is_fp64, otherwise floats
    uint32_t *host_words;
    ExplainedRay *rays;     // one per level
    ExplainedLight *lights; // one per level and light of the scene
    uint64_t sums[3];       // of ExplainedSample::steps over the pixel's samples
} Explainer;

// Prepares to explain the pixels of a picture of the session's scene. The session keeps the scene
// until the explainer is closed.
bool explainer_open(Explainer *explainer, Session *session, const RenderSettings *settings,
                    const Viewpoint *viewpoint, Error *error);
void explainer_close(Explainer *explainer);

// Traces a sample of a pixel into *sample, which stays valid until the next call. Callers trace all
// samples in order: index goes from 0 to the number of samples less 1.
bool explainer_trace(Explainer *explainer, const uint32_t pixel[2], uint32_t index,
                     ExplainedSample *sample, Error *error);

// Stores the pixel's color. explainer_trace must have traced all samples of the pixel.
void explainer_mix(const Explainer *explainer, float color[3]);
