// SPDX-License-Identifier: MIT
// What a run cost, as text and as JSON.
#pragma once

#include "cli/options/options.h"
#include "compare/difference.h"
#include "image/stored_image.h"

#include <stdio.h>

// What a picture differs by from its reference.
typedef struct {
    uint32_t samples; // of the reference, a pixel; 0 where none was drawn
    Difference difference;
    double own_error; // of the reference: RMSE, as two independent halves of it tell
    double seconds;
} ReferenceResult;

// How many pixels are how certain.
typedef struct {
    uint64_t pixels[CERTAINTY_KINDS]; // zeros where nobody asked
    double seconds;
} CertaintyResult;

// Everything about one run that is told to the user.
typedef struct {
    const Options *options;
    const RenderSettings *settings;
    const KernelChoice *choice;
    const char *device_name, *device_version;
    uint32_t view; // from 1
    double turned; // degrees, on a turntable
    uint64_t scene_hash[2], mesh_hash[2];
    uint32_t lights, spheres, triangles;
    uint64_t dropped_triangles;
    uint32_t bvh_nodes, bvh_leaves, bvh_depth, bvh_largest_leaf;
    uint32_t bvh_inner[BVH_MAX_DEPTH]; // inner nodes at every depth
    size_t upload_size;
    double contrast;   // that refining left, 0 where nothing was refined
    double estimate;   // of the error, with the bound of the truncation; 0 where there is none
    double bound;      // likewise, that exceeds it with a confidence of 95 %
    bool goal_missed;  // of --error or --time
    double truncation; // bound of the error that max_level makes
    uint64_t pixels;   // that this run has drawn
    uint64_t samples;  // of all of them together
    bool specialized;
    bool complete;
    uint64_t tiles_done;
    uint64_t tallies[TALLY_KINDS];
    // Seconds.
    double parse, load, build, device, upload, kernel_build, trace, write, total;
    double frame_seconds[REPEAT_MAX]; // of every picture drawn; the first is trace
    uint32_t frame_count;
    ReferenceResult reference;
    CertaintyResult certainty;
    char pixel_hash[FRAMEBUFFER_HASH_SIZE];
} Report;

// Takes what there is to tell of a scene and its tree.
void report_count_scene(Report *report, const Scene *scene, const Bvh *bvh);

// The tree's builder, as --bvh has it, or none.
const char *report_tree_name(const Report *report);

// The error of a picture that was measured against a reference, on stream.
void report_write_error(const Report *report, FILE *stream);

// The figures the course prints, on stream.
void report_write_text(const Report *report, FILE *stream);

// Versioned JSON with sorted keys, at path ("-": standard output).
bool report_write_json(const Report *report, const char *path, Error *error);
