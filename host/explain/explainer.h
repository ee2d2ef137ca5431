// SPDX-License-Identifier: MIT
// One sample of a picture -> its rays in scene coordinates, with hits and the state of each light.
// A separate kernel traces the sample again with the picture's functions.
#pragma once

#include "image/image_file.h"
#include "render/renderer.h"
#include "scene/normalize.h"
#include "scene/scene.h"

#include <jansson.h>
#include <stdio.h>

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
    double share;                 // weight of `shaded` in the sample's color
    Vec3 shaded;                  // surface color without reflections
    const ExplainedLight *lights; // one per light of the scene; unset unless uses_lights
} ExplainedRay;

// A reflective surface that rays[ray_count - 1] hits shows the background, because the next ray
// would have the level max_level.
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
    uint64_t sums[3];       // of ExplainedSample::steps over the pixel's samples
} Explainer;

// The inputs of explainer_open. renderer, scene and normalization must outlive the Explainer.
typedef struct {
    const RendererSetup *setup;
    const Renderer *renderer;
    const Scene *scene;
    const Normalization *normalization;
    CameraData camera;
} ExplainerSource;

bool explainer_open(Explainer *explainer, const ExplainerSource *source, Error *error);
void explainer_close(Explainer *explainer);

// Traces a sample of a pixel into *sample, which stays valid until the next call. Callers trace all
// samples in order: index goes from 0 to the number of samples less 1.
bool explainer_trace(Explainer *explainer, const uint32_t pixel[2], uint32_t index,
                     ExplainedSample *sample, Error *error);

// Stores the pixel's color. explainer_trace must have traced all samples of the pixel.
void explainer_mix(const Explainer *explainer, float color[3]);

// A primitive's name for users: a sphere's number in the scene, or a triangle's mesh file and
// number in that file.
typedef struct {
    bool is_sphere;
    size_t number;    // spheres from 1, triangles from 0
    const char *path; // of the triangle's mesh; NULL for a sphere
} PrimitiveName;

PrimitiveName name_primitive(const Scene *scene, uint32_t id);

// Returns the name of a defined or imported material, or the number of a material of the course.
// The string belongs to the scene or is static.
const char *name_material(const Scene *scene, uint32_t material);

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
