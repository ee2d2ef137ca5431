// SPDX-License-Identifier: MIT
// The steps of a picture in a file: rendering, certifying, and measuring the error against a
// reference.
#pragma once

#include "cli/run.h"
#include "jobs/resume.h"
#include "session/channels.h"

// A picture in progress. The frames of a run use one Picture in succession.
typedef struct {
    Run *run;         // the scene, the session and the report
    const char *path; // of the output file
    Viewpoint viewpoint;
    Framebuffer framebuffer;
    Framebuffer film;       // the frames of an animated file, below each other; empty without one
    Framebuffer reference;  // empty without --reference
    Layers layers;          // the channels besides the colors
    CertaintyMap certainty; // empty without --aov certainty
    Resume resume;          // empty without --resume
    int stopped_by;         // the signal that stopped the picture, or 0
    double moment;          // the end of the previous frame, or the start of the run
} Picture;

// Prints a note if the error goal is so large that the user may have meant a percentage.
void picture_warn_of_goal(const Options *options);

// Prints a note if the parts have so few tiles that their times may differ much.
void picture_warn_of_few_tiles(const Options *options, const RenderSettings *settings);

// With --verbose, prints the start of each picture.
void picture_print_beginning(const Picture *picture);

// On a terminal, prints the file's name, the picture's size and the seconds since picture->moment.
// Sets the moment to the current time.
void picture_print_end(Picture *picture);

// Fill error for a picture that misses its goal or is stopped, and return the exit status.
ExitCode picture_fail_goal(const Options *options, const Report *report, Error *error);
ExitCode picture_fail_stopped(const Picture *picture, Error *error);

// Appends the channel of each pixel's error: the largest difference of its colors from the
// reference. Does nothing without a reference, without channels in the file's format, or if --aov
// already lists the channel.
void reference_name_layer(const Options *options, Layers *layers);

// Renders the view again with many other samples and the accuracy of fp64, into picture->reference.
// Measures the difference and fills the error channel. The reference's rays reach the level of the
// scene or of the settings, whichever is higher. Measures nothing if a signal stops the picture or
// the reference.
bool reference_measure(Picture *picture, Error *error);

// Writes the reference in the format of the path's ending.
bool reference_write(const Picture *picture, const char *path, Error *error);

// Computes the certainty of each pixel of a finished picture, repairs pixels in fp64, and stores
// the counts in the report. If the picture was stopped earlier, it stays unchanged and uncertified.
bool certain_picture_make(Picture *picture, Error *error);

// Returns the request for the picture's view.
SessionPicture picture_request(const Picture *picture);
