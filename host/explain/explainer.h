// SPDX-License-Identifier: MIT
// A sample of a picture -> its rays, each with its hit and the lights that reach the hit, in scene
// coordinates.  A separate kernel, built from the picture's functions, traces the sample again.
#pragma once

#include "render/renderer.h"
#include "scene/normalize.h"
#include "scene/scene.h"

typedef struct {
    LightState state;
    double cosine;           // between the normal and the direction to the light
    double distance;         // to the light
    uint32_t blocker;        // id of a primitive in between, or NOTHING
    double blocker_distance; // from the point
    double diffuse;          // received: intensity * cosine
    double specular;         // received: intensity * highlight
} ExplainedLight;

typedef struct {
    Vec3 origin, direction; // of length 1
    double weight;          // of the ray's color in the sample's
    uint32_t primitive;     // id; NOTHING for a miss, which leaves the rest unset
    double distance, error; // error bounds the error of distance
    Vec3 point, normal;
    uint32_t material;
    bool uses_lights;             // false for silhouettes
    double share;                 // weight of shaded in the sample's color
    Vec3 shaded;                  // the surface's own color
    const ExplainedLight *lights; // one per light of the scene
} ExplainedRay;

// A last ray with a reflective hit has reached max_level: its reflection is the background.
typedef struct {
    uint32_t ray_count;
    const ExplainedRay *rays; // the camera ray, then the reflections
    double background_weight; // of the background in the color; 0 if no ray reached it
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
    cl_mem values, words, result, count; // of one sample, on the device
    void *host_values;                   // floats; doubles in fp64
    uint32_t *host_words;
    ExplainedRay *rays;     // max_level entries
    ExplainedLight *lights; // max_level entries per light of the scene
} Explainer;

// The inputs of an explainer, which must outlive it.
typedef struct {
    const RendererSetup *setup;
    const Renderer *renderer;
    const Scene *scene;
    const Normalization *normalization;
    CameraData camera;
} ExplainerSource;

bool explainer_open(Explainer *explainer, const ExplainerSource *source, Error *error);
void explainer_close(Explainer *explainer);

// Traces the sample at column and row, both in samples.  The result is valid until the next call.
bool explainer_trace(Explainer *explainer, uint32_t column, uint32_t row, ExplainedSample *sample,
                     Error *error);

// Returns in color the pixel's color for these sums of its samples' steps.
void explainer_mix(const Explainer *explainer, const uint64_t sums[3], float color[3]);

// A primitive's name for users: a sphere has its number in the file, and a triangle has its mesh
// and its number there.
typedef struct {
    bool is_sphere;
    size_t number;    // spheres from 1, triangles from 0
    const char *path; // of the triangle's mesh; NULL for a sphere
} PrimitiveName;

PrimitiveName name_primitive(const Scene *scene, uint32_t id);

// Returns the name that a define statement gave the material, or the course's number. The scene
// owns the string, or it is static.
const char *name_material(const Scene *scene, uint32_t material);
