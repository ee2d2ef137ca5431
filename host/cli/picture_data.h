// SPDX-License-Identifier: MIT
// The data of a picture that clrt renders to a file.
#pragma once

#include "cli/stages.h"
#include "jobs/resume.h"
#include "session/picture.h"

// A picture's reference, and the picture's difference from the reference.
typedef struct {
    Framebuffer picture; // empty without --reference
    uint32_t samples;    // per pixel; 0 until the difference is measured
    Difference difference;
    double own_error; // the reference's RMSE, estimated from its two independent halves
    double seconds;
} MeasuredReference;

// A picture in progress. All frames of a run use one Picture in succession.
typedef struct {
    const Options *options;
    Session *session;
    Scene *scene;
    SessionPicture request; // for the frame's view
    const char *path;       // of the output file
    uint32_t view;          // from 1
    double turned;          // the turntable's angle in degrees
    Framebuffer framebuffer;
    Framebuffer film; // all frames of an animated file, in a column; empty for other files
    MeasuredReference reference;
    Layers layers;        // the channels other than the colors
    Resume resume;        // empty without --resume
    int stopped_by;       // the signal that stopped the picture, or 0
    double start, moment; // start of the command; end of the previous frame, initially `start`

    // The following members are for reports.
    const SceneForm *form; // the scene in the layout of the picture's kernels
    PictureResult drawn;
    bool complete; // all colors and channels are drawn
    StageSeconds stages;
    double certainty_seconds, write_seconds, total_seconds;
    double repetition_seconds[REPEAT_MAX]; // one entry per repetition
    uint32_t repetition_count;
    char pixel_hash[FRAMEBUFFER_HASH_SIZE];
} Picture;
