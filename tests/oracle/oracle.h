// SPDX-License-Identifier: MIT
// A second ray tracer as a reference. It traces a Scene on the host in fp64, in the scene's
// coordinates, by recursion and without a tree. It shares no method with the kernels. Besides a
// color, it returns the decisions behind the color. Tests use the decisions to distinguish a
// renderer's errors from samples that are merely on the other side of an edge.
#pragma once

#include "image/framebuffer.h"
#include "oracle/blocks.h"
#include "oracle/surface.h"

typedef struct {
    const Scene *scene; // borrowed
    OracleBlocks blocks;
} Oracle;

// scene must outlive the oracle.
bool oracle_make(Oracle *oracle, const Scene *scene, Error *error);
void oracle_free(Oracle *oracle);

// The camera and size of a picture. right and down are one pixel long on the image plane at
// distance 1. If is_parallel is set, all rays have the direction forward.
typedef struct {
    const Oracle *oracle;
    Vec3 eye, forward, right, down;
    bool is_parallel;
    uint32_t width, height; // in pixels
    uint32_t max_level;     // rays of this level return the background
} OracleView;

OracleView oracle_view(const Oracle *oracle, const Viewpoint *viewpoint, uint32_t width,
                       uint32_t height, uint32_t max_level);

// The decisions of a ray tree. For each ray except shadow rays, they are the hit object, its side,
// whether its cube is odd, and the lights that reach the point.
typedef struct {
    uint64_t signature; // a hash of all decisions
    bool grazes;        // a light is so low that rounding may decide whether it shines
} OracleDecisions;

typedef struct {
    Vec3 color; // in [0, 1]
    OracleDecisions decisions;
} OracleSample;

// Returns the sample at x, y, in pixels from the picture's top left corner.
OracleSample oracle_sample(const OracleView *view, double x, double y);

// The first hit of a camera ray, and its path from there.
typedef struct {
    double depth;          // along the view's axis; INFINITY without a hit
    OracleSurface surface; // zero without a hit
    uint32_t lights;       // the number of lights that reach the hit
    uint32_t bounces;      // the number of reflected rays
} OraclePath;

OraclePath oracle_path(const OracleView *view, double x, double y);

// Returns the path of a ray from the eye. direction must have length 1.
OraclePath oracle_follow(const OracleView *view, Vec3 direction);

// Draws every step-th pixel of every step-th row. Each pixel is the mean of samples * samples
// samples.
bool oracle_draw(const OracleView *view, uint32_t samples, uint32_t step, Framebuffer *framebuffer,
                 Error *error);

typedef enum {
    EXPLAINED_NOT,
    EXPLAINED_BY_EDGE,   // decisions differ within a distance of one pixel
    EXPLAINED_BY_CREASE, // decisions are equal, and the range of nearby colors contains the color
    EXPLAINED_BY_HORIZON // neither applies, but a light grazes the surface
} Explanation;

// Returns why a float renderer may give a color that differs from the color of the oracle, or
// EXPLAINED_NOT without a reason. Examines 5 x 5 samples, half a pixel apart, around the center of
// pixel (x, y).
Explanation oracle_explains(const OracleView *view, uint32_t x, uint32_t y, const float color[3]);
