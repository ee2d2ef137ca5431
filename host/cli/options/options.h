// SPDX-License-Identifier: MIT
// What the command line asks for.
#pragma once

#include "accel/bvh.h"
#include "cli/options/crop.h"
#include "cli/options/frames.h"
#include "compare/limits.h"
#include "image/image_file.h"
#include "render/aov.h"
#include "render/renderer.h"

#include <string.h>

typedef enum {
    ACTION_RENDER,
    ACTION_HELP,
    ACTION_VERSION,
    ACTION_LIST_DEVICES,
    ACTION_WARM,
    ACTION_VIEW,
    ACTION_CHECK,
    ACTION_COMPARE,
    ACTION_MERGE,
    ACTION_CONVERT,
    ACTION_EXPLAIN,
    ACTION_EXPLAIN_SCENE
} Action;

// What the process returns: 128 + signal when a signal stopped it.
typedef enum {
    EXIT_DONE = 0,
    EXIT_FAULTS = 1, // found by check, limits broken in compare, another hash, or a goal missed
    EXIT_USAGE = 2,
    EXIT_SCENE = 3, // or a picture that is read
    EXIT_DEVICE = 4,
    EXIT_OUTPUT = 5
} ExitCode;

// What happens to triangles of no area, which no ray can meet.
typedef enum {
    BAD_GEOMETRY_DROP, // those with two equal corners are left out; the others are harmless
    BAD_GEOMETRY_FAIL
} BadGeometry;

#define REPEAT_MAX 1000

// Parts that a picture is drawn in.
#define PARTS_MAX 65536

// Samples a pixel of a reference: unless they are given, and at most.
#define REFERENCE_SAMPLES     256
#define REFERENCE_SAMPLES_MAX 65536

// Sides of tiles unless they are given; a window chooses its own.
#define OPTIONS_TILE 128

#define TIME_GOAL_MOST 1000000 // seconds

// The most that options take.
#define VIEW_MOST       1000000
#define GROUP_SIDE_MOST 1024
#define THREADS_MOST    4096
#define QUIT_AFTER_MOST 1000000

// Strings point into the command line.
typedef struct {
    Action action;
    uint64_t given;         // a bit for each row of option_table that the command line names
    const char *scene_path; // NULL where ACTION_WARM was given none; ACTION_COMPARE's first picture
    char **part_paths;      // of ACTION_MERGE: part_count of them
    int part_count;
    const char *other_path;  // ACTION_COMPARE's second, what ACTION_CONVERT writes
    const char *output_path; // "-": standard output; NULL without -o, which opens the window
    const char *format;      // one of image_format_names; NULL without an output
    AovSet aovs;             // channels beside the colors
    uint32_t samples;        // per pixel and axis
    double contrast;         // that adaptive anti-aliasing leaves; 0: none is asked for
    double error_goal;       // root mean square that the picture may be off; 0: any
    double time_goal;        // seconds that tracing is to take; 0: any
    uint32_t view;           // from 1
    uint32_t width, height;  // 0: the scene's
    Crop crop;
    uint32_t part, parts; // from 1; 0, 0: all of the picture
    bool resume;
    Frames frames;
    int64_t max_level; // negative: the scene's
    bool fits_level;   // max_level is the least whose error no file shows
    bool uses_bvh;
    BvhBuilder builder;
    const char *device;         // NULL: the best
    uint32_t threads;           // 0: all that the process may use
    bool reference;             // the picture is measured against one
    const char *reference_path; // where that is written, NULL for nowhere
    uint32_t reference_samples; // a pixel, an even number
    uint32_t repeat;            // how often the picture is drawn, from 1
    uint32_t tile_width, tile_height;
    uint32_t group_width, group_height; // 0: what suits the kernels
    KernelRequest kernel;
    Specialization specialization;
    bool statistics;
    const char *statistics_path; // NULL: text on standard error; "-": JSON on standard output
    Encoding encoding;
    bool no_metadata;          // in files of pictures
    bool hash;                 // of the pixels is told
    const char *expected_hash; // of the pixels, NULL where none is
    const char *keys;          // to play in the window, NULL for none
    uint32_t quit_after;       // frames in the window; 0: when the user quits
    BadGeometry bad_geometry;
    bool lists_json;       // of ACTION_LIST_DEVICES
    Limits limits;         // of ACTION_COMPARE
    uint32_t pixel[2];     // of ACTION_EXPLAIN: column and row
    bool json;             // of ACTION_CHECK, ACTION_COMPARE, ACTION_EXPLAIN, ACTION_EXPLAIN_SCENE
    const char *json_path; // NULL or "-": standard output, in place of the text
    bool quiet, verbose;
} Options;

// Whether pixels get as many samples as they need, instead of all the same.
static inline bool options_are_adaptive(const Options *options)
{
    return options->contrast > 0 || options->error_goal > 0 || options->time_goal > 0;
}

// Returns whether the scene is read from standard input, which can be read once.
static inline bool options_read_input(const Options *options)
{
    return strcmp(options->scene_path, "-") == 0;
}
