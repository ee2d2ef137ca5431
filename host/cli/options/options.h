// SPDX-License-Identifier: MIT
// The parsed command line.
#pragma once

#include "base/error.h"
#include "compare/difference.h"
#include "image/image_file.h"
#include "scene/scn.h"
#include "session/picture.h"
#include "session/request.h"

#include <jansson.h>
#include <stdint.h>
#include <string.h>

// "I/N" is the I-th of N shares of a job. "auto/N" reads I from the environment variable in which
// Slurm, AWS Batch, Kubernetes or MPI stores the task's number.

typedef struct {
    uint32_t index, count; // index from 1 to count; 0, 0: the whole job
} Share;

// Parses `text`. If `text` is malformed or violates 1 <= I <= N <= most, returns false and leaves
// *error empty. If the environment variable is missing, not a number or out of range, returns false
// and fills *error.
bool share_parse(Share *share, const char *text, uint32_t most, Error *error);

// Returns the index of the share's first item among `total` items. Shares are runs of consecutive
// items, and their lengths differ by at most one.
uint32_t share_begin(const Share *share, uint32_t total);

// The frames of a run and their file names. A frame is a view or a step of a turntable.

#define FRAMES_MOST 1000000

typedef struct {
    uint32_t first, last, step; // last is 0 without a range
    uint32_t turntable;         // steps per full turn; 0: frames are views
    bool is_film;               // one animated file instead of numbered files
    Share share;                // of the frames above; frames_complete applies and clears it
    bool skips_finished;        // skip frames whose files exist, and write only complete frames
} Frames;

// Parses a range ("A-B" or "A-B:S"), a share, or a range and a share with a comma between them.
// Returns false on failure, and fills *error as share_parse does.
bool frames_parse(Frames *frames, const char *text, Error *error);

// Returns whether --frames or --turntable is given.
bool frames_are_many(const Frames *frames);

// Completes the selection of frames. Without a range, selects all steps of the turntable. Then
// reduces the range to the share, if any. Fails if there is neither a range nor a turntable, or if
// there are fewer frames than shares.
bool frames_complete(Frames *frames, Error *error);

// Returns the number of frames, which is 1 without --frames and --turntable.
uint32_t frames_count(const Frames *frames);

// Returns the number of the frame at index `place`, which counts from 0.
uint32_t frames_at(const Frames *frames, uint32_t place);

// Returns the path of a frame's file. The number with leading zeros replaces the last run of '#'
// after the last slash of `pattern`. Without a '#', the number is inserted before the ending, as in
// ".0001.png". The caller frees the path. Returns NULL if memory is exhausted.
char *frames_name(const char *pattern, uint32_t number, Error *error);

// --crop "X0,Y0,X1,Y1". The numbers are pixels, or fractions of the sides if any number has a dot.
typedef struct {
    bool is_given;
    bool in_parts;     // fractions of the sides, each from 0 to 1
    double corners[4]; // left, top, right and bottom; right and bottom are exclusive
} Crop;

// Returns false if `text` is malformed, a number is out of range, or the crop is empty.
bool crop_parse(Crop *crop, const char *text);

// Sets the crop of *picture, whose size must be set. Rounds fractions to the nearest pixel edge, so
// neighboring crops neither overlap nor leave gaps. Fails if the crop is empty or too large.
bool crop_apply(const Crop *crop, ClrtPicture *picture, Error *error);

// Returns [left, top, right, bottom] of the crop, in pixels of the whole picture.
json_t *crop_json(const RenderSettings *settings);

typedef enum {
    ACTION_RENDER,
    ACTION_VIEW,
    ACTION_CHECK,
    ACTION_COMPARE,
    ACTION_MERGE,
    ACTION_CONVERT,
    ACTION_EXPLAIN_SCENE,
    ACTION_EXPLAIN, // a pixel
    ACTION_WARM,
    ACTION_DEVICES,
    ACTION_HELP,
    ACTION_VERSION
} Action;

// The exit status. If a signal stopped the process, the status is 128 + the signal's number.
typedef enum {
    EXIT_DONE = 0,
    EXIT_FAULTS = 1, // faults found by check, an exceeded limit, an unexpected hash, a missed goal
    EXIT_USAGE = 2,
    EXIT_SCENE = 3, // a faulty scene, mesh or input picture
    EXIT_DEVICE = 4,
    EXIT_OUTPUT = 5,
    EXIT_BUSY = 75 // another process draws the picture; EX_TEMPFAIL of sysexits.h
} ExitCode;

// The treatment of triangles without area.
typedef enum {
    BAD_GEOMETRY_DROP, // drop those with two equal corners, and keep the others
    BAD_GEOMETRY_FAIL
} BadGeometry;

#define REPEAT_MAX 1000

// The largest values of options.
#define EXPOSURE_MOST 8 // stops, as the window's keys allow
#define VIEW_MOST     1000000
#define THREADS_MOST  4096

// Strings point into the command line or are static.
typedef struct {
    Action action;
    uint64_t given;         // bit i: the command line contains the option of row i of option_table
    const char *scene_path; // the first picture of ACTION_COMPARE; NULL if no scene is named
    char **part_paths;      // part_count file names of ACTION_MERGE
    int part_count;
    const char *other_path;  // the second picture of ACTION_COMPARE; the output of ACTION_CONVERT
    const char *output_path; // "-": standard output; NULL without -o
    const char *format;      // of the output; "pfm" with a hash alone; NULL without output and hash
    AovSet aovs;             // channels other than the colors
    ClrtPicture picture;     // without crop, camera and truncation, which need the scene
    ClrtSettings renderer;
    SceneLoadOptions load;
    Crop crop;
    uint32_t part, parts; // part counts from 1; 0, 0: the whole picture
    bool resume;          // of a single picture; frames use skips_finished
    Frames frames;
    bool fits_level; // use the smallest max_level whose error is invisible in a file of this format
    bool reference;  // measure the picture against a reference
    const char *reference_path; // the file for the reference; NULL: do not write it
    uint32_t repeat;            // the number of times to draw the picture, at least 1
    Encoding encoding;
    double exposure;           // in stops
    bool no_metadata;          // omit the metadata of picture files
    bool hash;                 // print the hash of the pixels, or check it
    const char *expected_hash; // NULL: none, so print the hash
    const char *keys;          // key presses to play in the window; NULL for none
    BadGeometry bad_geometry;
    Limits limits;         // of ACTION_COMPARE
    uint32_t pixel[2];     // of ACTION_EXPLAIN: column and row
    const char *json_path; // the file of the report; NULL: none; "-": standard output, instead of
                           // the text
    bool quiet, verbose;
} Options;

// Returns whether JSON replaces the text on standard output.
static inline bool options_print_json(const Options *options)
{
    return options->json_path != NULL && strcmp(options->json_path, "-") == 0;
}

// Returns whether the scene comes from standard input, which can be read only once.
static inline bool options_read_input(const Options *options)
{
    return strcmp(options->scene_path, "-") == 0;
}

// Parses the command line into *options.
bool options_parse(Options *options, int count, char **arguments, Error *error);
