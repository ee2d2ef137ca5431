// SPDX-License-Identifier: MIT
// The steps of a picture in a file: drawing it with as many samples per pixel as it needs,
// certifying it, and measuring its error against a reference.
#pragma once

#include "cli/run.h"
#include "jobs/resume.h"
#include "render/certifier.h"

// A picture while it is made, or one frame after another.  {0} is a valid empty value.
typedef struct {
    Run *run;         // the scene, the renderer and the report
    const char *path; // of its file
    Viewpoint viewpoint;
    Framebuffer framebuffer;
    Framebuffer reference;  // empty without --reference
    Layers layers;          // the channels besides the colors
    uint32_t *samples;      // samples per pixel, for the layers; NULL if all pixels have the same
    CertaintyMap certainty; // empty without --aov certainty
    Resume resume;          // empty without --resume
    int stopped_by;         // a signal; 0 if the picture is complete
} Picture;

// Warns of an error goal that may be meant as a percentage.
void picture_warn_of_goal(const Options *options);

// With --verbose, print the scene, the device and the kernels; and where a picture starts.
void picture_print_setup(const Run *run);
void picture_print_beginning(const Picture *picture);

// Fill error for a picture that misses its goal or is stopped, and return the exit status.
ExitCode picture_fail_goal(const Run *run, Error *error);
ExitCode picture_fail_stopped(const Picture *picture, Error *error);

// A reference is the same view drawn again in fp64, with many samples different from the picture's.

// Adds the channel of each pixel's error, the largest difference of its colors, after the others.
// Does nothing unless the options request it and the file's format supports it.
void reference_name_layer(const Options *options, Layers *layers);

// Draws the reference of a picture into its reference, measures the difference and fills the
// error channel.  Its rays reach the level of the scene or of the picture's settings, whichever is
// higher.  If the picture or its reference is stopped, nothing is measured.
bool reference_measure(Picture *picture, Error *error);

// Writes the reference, in the format of the path's ending.
bool reference_write(const Picture *picture, const char *path, Error *error);

// Draws the picture and stores its cost in the report.
bool refined_picture_draw(Picture *picture, const CameraData *camera,
                          const RenderObserver *observer, Error *error);

// Computes the certainty of each pixel and repairs pixels in fp64: fills the run's certainty,
// repairs its finished picture and stores the counts in its report.  A stopped picture stays
// unchanged, without any certified pixel.
bool certain_picture_make(Picture *picture, const CameraData *camera, Error *error);
