// SPDX-License-Identifier: MIT
// A second ray tracer as a reference: it traces a Scene as read, on the host, in fp64, in the
// file's own coordinates, by recursion and without a tree. It shares no method with the kernels.
// Beside a color it returns the decisions behind it, which separates errors from edges that fall on
// the other side of a sample.
#pragma once

#include "image/framebuffer.h"
#include "oracle/blocks.h"
#include "oracle/surface.h"

typedef struct {
    const Scene *scene; // borrowed
    OracleBlocks blocks;
} Oracle;

// Keeps a pointer to scene, which must outlive the oracle.
bool oracle_make(Oracle *oracle, const Scene *scene, Error *error);
void oracle_free(Oracle *oracle);

// A picture's rays.  right and down step one pixel on the image plane at distance 1.
typedef struct {
    const Oracle *oracle;
    Vec3 eye, forward, right, down;
    uint32_t width, height; // pixels
    uint32_t max_level;     // rays of this level return the background
} OracleView;

OracleView oracle_view(const Oracle *oracle, const Viewpoint *viewpoint, uint32_t width,
                       uint32_t height, uint32_t max_level);

// The decisions of a ray tree: the object hit by the camera ray and by each reflected one, the
// side, and the lights that reach the point.
typedef struct {
    uint64_t signature; // a hash of all that
    bool grazes;        // a light stands so low over a true surface that a point's last bits decide
} OracleDecisions;

typedef struct {
    Vec3 color; // in [0, 1]
    OracleDecisions decisions;
} OracleSample;

// The sample at x and y pixels from the picture's top left corner.
OracleSample oracle_sample(const OracleView *view, double x, double y);

// The first hit of the sample's ray, and its path from there.
typedef struct {
    double depth;          // along the view's axis; INFINITY where nothing is met
    OracleSurface surface; // zero there
    uint32_t lights;       // that reach it
    uint32_t bounces;      // reflected rays followed
} OraclePath;

OraclePath oracle_path(const OracleView *view, double x, double y);

// The same of a ray from the eye in a direction of length 1.
OraclePath oracle_follow(const OracleView *view, Vec3 direction);

// Makes a picture of every step-th pixel of every step-th row, each the mean of samples * samples.
bool oracle_draw(const OracleView *view, uint32_t samples, uint32_t step, Framebuffer *framebuffer,
                 Error *error);

typedef enum {
    EXPLAINED_NOT,
    EXPLAINED_BY_EDGE,   // decisions differ within a pixel's distance
    EXPLAINED_BY_CREASE, // they do not, yet the colors there span the one in question
    EXPLAINED_BY_HORIZON // neither, but a light grazes
} Explanation;

// Why a renderer in float may give the color where the oracle gives another: judged by 5 x 5
// samples half a pixel apart, around the center of pixel (x, y).
Explanation oracle_explains(const OracleView *view, uint32_t x, uint32_t y, const float color[3]);
