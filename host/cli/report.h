// SPDX-License-Identifier: MIT
// Writes the costs and results of a run as text and as JSON.
#pragma once

#include "cli/options/options.h"
#include "compare/difference.h"
#include "image/provenance.h"
#include "image/stored_image.h"

#include <stdio.h>

// The difference between a picture and its reference.
typedef struct {
    uint32_t samples; // of the reference, per pixel; 0 without a reference
    Difference difference;
    double own_error; // the reference's RMSE, estimated from its two independent halves
    double seconds;
} ReferenceResult;

// The number of pixels of each Certainty (kernels/shared.h).
typedef struct {
    uint64_t pixels[CERTAINTY_KINDS]; // zeros without --aov certainty
    double seconds;
} CertaintyResult;

// The facts about a run that the reports contain.
typedef struct {
    const Options *options;
    const RenderSettings *settings;
    const KernelChoice *choice;
    const char *device_name, *device_version;
    uint32_t view; // from 1
    double turned; // the turntable's angle in degrees
    uint64_t scene_hash[2], mesh_hash[2];
    uint32_t lights, spheres, triangles;
    uint64_t dropped_triangles;
    uint32_t bvh_nodes, bvh_leaves, bvh_depth, bvh_largest_leaf;
    uint32_t bvh_inner[BVH_MAX_DEPTH]; // inner nodes at each depth
    size_t upload_size;
    double contrast;   // the limit of adaptive anti-aliasing; 0 without it
    double estimate;   // of the RMSE, including truncation by --error; 0 without a goal
    double bound;      // the RMSE is lower with 95 % confidence
    bool goal_missed;  // the goal of --error or --time
    double truncation; // the largest color error caused by max_level
    uint64_t pixels;   // drawn by this process
    uint64_t samples;  // total of these pixels
    bool specialized;
    bool complete;
    uint64_t tiles_done;
    uint64_t tallies[TALLY_KINDS];
    // Seconds.
    double parse, load, build, device, upload, kernel_build, trace, write, total;
    double frame_seconds[REPEAT_MAX]; // one entry per repetition; the first equals trace
    uint32_t frame_count;
    ReferenceResult reference;
    CertaintyResult certainty;
    char pixel_hash[FRAMEBUFFER_HASH_SIZE];
} Report;

// Stores the hashes and counts of a scene and its tree.
void report_count_scene(Report *report, const Scene *scene, const Bvh *bvh);

// Returns the builder's name in --bvh, or "none" without a tree.
const char *report_tree_name(const Report *report);

// Prints the error against the reference, if one was drawn.
void report_write_error(const Report *report, FILE *stream);

// Prints time, samples, rays and tests, like the course's program.
void report_write_text(const Report *report, FILE *stream);

// Writes versioned JSON with sorted keys to path ("-": standard output).
bool report_write_json(const Report *report, const char *path, Error *error);

// Fills the texts that the picture's file stores.
void report_fill_provenance(Provenance *provenance, const Report *report);

// Prints the hash of the pixels if the options request it. Fails if the hash differs from the
// expected hash.
bool report_print_hash(const Options *options, const char *hash, Error *error);
